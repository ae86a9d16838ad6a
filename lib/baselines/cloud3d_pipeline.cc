#include "baselines/cloud3d_pipeline.h"

#include "baselines/stage_clock.h"

namespace lcmslam::cloud3d {
namespace {

constexpr size_t kMinPoints = 100;
constexpr double kUsToS = 1e-6;

double SecondsBetween(int64_t from_utime, int64_t to_utime) {
  return kUsToS * (static_cast<double>(to_utime) - static_cast<double>(from_utime));
}

// Of the finite points, before the last one, which is at 0.
double MeanTime_s(const Sweep& sweep) {
  double sum_us = 0.0;
  int64_t count = 0;
  for (const SweepPoint& point : sweep.points) {
    if (!point.IsFinite()) continue;
    sum_us += point.dt_us;
    ++count;
  }
  return count > 0 ? kUsToS * sum_us / static_cast<double>(count) : 0.0;
}

// The motion, gone on with for `ratio` times as long.
Pose3 Scaled(const Pose3& motion, double ratio) {
  const Eigen::AngleAxisd turn(motion.rotation);
  return {motion.translation * ratio, Eigen::Quaterniond(Eigen::AngleAxisd(turn.angle() * ratio, turn.axis()))};
}

}  // namespace

std::string Options::Validate() const {
  if (const std::string error = filter.Validate(); !error.empty()) return "filter." + error;
  if (const std::string error = icp.Validate(); !error.empty()) return "icp." + error;
  if (const std::string error = map.Validate(); !error.empty()) return "map." + error;
  if (!(reading_ratio > 0.0 && reading_ratio <= 1.0)) return "reading_ratio: must be in (0, 1]";
  if (!(update_distance_m >= 0.0)) return "update_distance_m: must not be negative";
  if (!(update_angle_rad >= 0.0)) return "update_angle_rad: must not be negative";
  if (!(max_gap_s > 0.0)) return "max_gap_s: must be positive";
  return "";
}

Pipeline::Pipeline(const Options& options) : options_(options), map_(options.map), random_(options.seed) {}

Result Pipeline::Process(const Sweep& sweep, const std::optional<Pose3>& T_before_now) {
  StageClock<Stage, kNumStages> clock(now_ms_);
  const Cloud cloud_body = Filter(sweep, options_.filter, random_);
  clock.Finish(Stage::kFilter);

  const Pose3 T_map_body_guess = T_before_now ? T_map_body_ * *T_before_now : Predict(sweep.utime);
  Result result = Locate(cloud_body, T_map_body_guess);
  result.utime = sweep.utime;
  MoveTo(sweep.utime, result.T_map_body);
  if (options_.reach_last_point) result.T_map_body = PoseAtLastPoint(sweep);
  SetVelocity(result);
  clock.Finish(Stage::kIcp);

  if (result.IsPlaced() && !options_.localize_only && MovedEnough()) {
    result.map_points_added = map_.Grow(Transformed(T_map_body_, cloud_body));
    T_map_body_grown_ = T_map_body_;
  }
  clock.Finish(Stage::kGrowMap);
  result.stage_ms = clock.stage_ms();
  return result;
}

bool Pipeline::MovedEnough() const {
  return !T_map_body_grown_ ||
         Reaches(T_map_body_grown_->inverse() * T_map_body_, options_.update_distance_m, options_.update_angle_rad);
}

Pose3 Pipeline::Predict(int64_t utime) const {
  if (!utime_ || motion_s_ <= 0.0) return T_map_body_;
  const double gap_s = SecondsBetween(*utime_, utime);
  if (!(gap_s > 0.0 && gap_s <= options_.max_gap_s)) return T_map_body_;
  return T_map_body_ * Scaled(T_before_now_, gap_s / motion_s_);
}

Result Pipeline::Locate(const Cloud& cloud_body, const Pose3& T_map_body_guess) {
  const Cloud reading_body = RandomSample(cloud_body, options_.reading_ratio, random_);
  Result result;
  if (result.Begin(reading_body.size(), kMinPoints, map_.size() > 0, options_.localize_only, T_map_body_guess))
    result.Take(Icp(map_, reading_body, T_map_body_guess, options_.icp));
  return result;
}

Pose3 Pipeline::PoseAtLastPoint(const Sweep& sweep) const {
  return motion_s_ > 0.0 ? T_map_body_ * Scaled(T_before_now_, -MeanTime_s(sweep) / motion_s_) : T_map_body_;
}

void Pipeline::MoveTo(int64_t utime, const Pose3& T_map_body) {
  const double gap_s = utime_ ? SecondsBetween(*utime_, utime) : 0.0;
  T_before_now_ = T_map_body_.inverse() * T_map_body;
  motion_s_ = gap_s > 0.0 && gap_s <= options_.max_gap_s ? gap_s : 0.0;
  T_map_body_ = T_map_body;
  utime_ = utime;
}

void Pipeline::SetVelocity(Result& result) const {
  if (motion_s_ <= 0.0) return;
  const Eigen::AngleAxisd turn(T_before_now_.rotation);
  const Eigen::Quaterniond R_map_before = T_map_body_.rotation * T_before_now_.rotation.conjugate();
  result.velocity = R_map_before * T_before_now_.translation / motion_s_;
  result.angular_velocity = R_map_before * turn.axis() * (turn.angle() / motion_s_);
}

void Pipeline::Reset() {
  map_ = Map(options_.map);
  T_map_body_grown_.reset();
  random_.seed(options_.seed);
  SetPose(Pose3{});
}

void Pipeline::SetPose(const Pose3& T_map_body) {
  T_map_body_ = T_map_body;
  utime_.reset();
  motion_s_ = 0.0;
}

}  // namespace lcmslam::cloud3d
