#include "baselines/occupancy2d_pipeline.h"

#include <algorithm>
#include <cmath>

#include "baselines/stage_clock.h"
#include "lidar/deskew.h"

namespace lcmslam::occupancy2d {
namespace {

constexpr size_t kMinPoints = 3;  // a pose has three unknowns

std::vector<LogOddsGrid> EmptyLevels(const Options& options) {
  std::vector<LogOddsGrid> levels;
  LogOddsGrid::Options grid = options.grid;
  for (int i = 0; i < options.levels; ++i, grid.cell_m *= 2.0) levels.emplace_back(grid);
  return levels;
}

}  // namespace

std::string Options::Validate() const {
  if (const std::string error = grid.Validate(); !error.empty()) return "grid." + error;
  if (const std::string error = match.Validate(); !error.empty()) return "match." + error;
  if (levels < 1 || levels > 8) return "levels: must be in 1..8";
  if (!(update_distance_m >= 0.0)) return "update_distance_m: must not be negative";
  if (!(update_angle_rad >= 0.0)) return "update_angle_rad: must not be negative";
  if (!(min_range_m >= 0.0)) return "min_range_m: must not be negative";
  if (!(max_range_m > min_range_m)) return "max_range_m: must exceed min_range_m";
  if (!T_body_lidar.IsFinite()) return "T_body_lidar: must be finite";
  if (!T_map_body_initial.IsFinite()) return "T_map_body_initial: must be finite";
  return "";
}

Pipeline::Pipeline(const Options& options)
    : options_(options), levels_(EmptyLevels(options)), T_map_body_(options.T_map_body_initial) {}

Result Pipeline::Process(const PlanarScan& scan) {
  StageClock<Stage, kNumStages> clock(now_ms_);
  const std::vector<Eigen::Vector2d> p_body = EndPoints(scan);
  const Pose2 T_map_body_guess = T_map_body_ * odometry_.MotionUntil(scan.utime);
  clock.Finish(Stage::kPrepare);

  Result result = Locate(p_body, T_map_body_guess);
  result.utime = scan.utime;
  T_map_body_ = result.T_map_body;
  clock.Finish(Stage::kMatch);

  if (result.IsPlaced() && !options_.localize_only && MovedEnough()) {
    WriteMap(p_body);
    result.map_written = true;
  }
  clock.Finish(Stage::kWriteMap);
  result.stage_ms = clock.stage_ms();
  return result;
}

Result Pipeline::Locate(const std::vector<Eigen::Vector2d>& p_body, const Pose2& T_map_body_guess) const {
  Result result;
  if (result.Begin(p_body.size(), kMinPoints, T_map_body_written_.has_value(), options_.localize_only,
                   T_map_body_guess))
    result.Take(Match(levels_, p_body, T_map_body_guess, options_.match));
  return result;
}

std::vector<Eigen::Vector2d> Pipeline::EndPoints(const PlanarScan& scan) const {
  std::vector<Eigen::Vector2d> p_body;
  p_body.reserve(scan.beams.size());
  for (const ScanPoint& point :
       ReturnsInBody(scan, options_.T_body_lidar, options_.min_range_m, options_.max_range_m)) {
    p_body.push_back(point.p_body);
  }
  return p_body;
}

bool Pipeline::MovedEnough() const {
  return !T_map_body_written_ ||
         Reaches(T_map_body_written_->inverse() * T_map_body_, options_.update_distance_m, options_.update_angle_rad);
}

void Pipeline::WriteMap(const std::vector<Eigen::Vector2d>& p_body) {
  std::vector<Eigen::Vector2d> p_map(p_body.size());
  std::ranges::transform(p_body, p_map.begin(), [this](const Eigen::Vector2d& p) { return T_map_body_ * p; });
  const Eigen::Vector2d lidar_map = T_map_body_ * options_.T_body_lidar.translation();
  for (LogOddsGrid& level : levels_) level.Insert(lidar_map, p_map);
  T_map_body_written_ = T_map_body_;
}

void Pipeline::Reset() {
  levels_ = EmptyLevels(options_);
  T_map_body_ = options_.T_map_body_initial;
  T_map_body_written_.reset();
  odometry_ = {};
}

}  // namespace lcmslam::occupancy2d
