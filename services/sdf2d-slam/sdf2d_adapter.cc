#include <algorithm>
#include <cmath>

#include <lcmslam/sdf_tile_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "common/diagnostics.h"
#include "sdf2d-slam/sdf2d_slam.h"
#include "sdf2d/map_file.h"
#include "sdf2d/occupancy.h"
#include "sdf2d/pipeline.h"

namespace lcmslam {
namespace {

constexpr float kMetersPerUnit = 1e-4F;  // of a published distance: up to 3.2 m in an int16
constexpr size_t kTilesInTurn = 4;       // unchanged tiles published each time, for late joiners

void Describe(const sdf2d::Result& result, slam_diagnostics_t& diagnostics) {
  diagnostics.status = static_cast<int8_t>(result.status);
  diagnostics.iterations = result.iterations;
  diagnostics.num_points = result.num_points;
  diagnostics.inlier_ratio = static_cast<float>(result.inlier_ratio);
  diagnostics.residual_rms = static_cast<float>(result.residual_rms_m);
  diagnostics.range_sigma = static_cast<float>(result.range_sigma_m);
  SetCovariance(result.covariance, diagnostics);
  for (size_t axis = 0; axis < 3; ++axis) diagnostics.unobservable |= result.unobservable[axis] ? 1 << axis : 0;
  SetStages(sdf2d::kStageNames, result.stage_ms, diagnostics);
}

sdf_tile_t TileMessage(int64_t utime, double cell_m, const sdf2d::SdfTile& tile) {
  sdf_tile_t message{};
  message.utime = utime;
  message.cells_per_side = sdf2d::SdfTile::kSide;
  message.num_cells = sdf2d::SdfTile::kVertices;
  message.tile_x = tile.tile_x;
  message.tile_y = tile.tile_y;
  message.meters_per_cell = static_cast<float>(cell_m);
  message.meters_per_unit = kMetersPerUnit;
  for (int i = 0; i < sdf2d::SdfTile::kVertices; ++i) {
    const auto [distance_m, information] = tile.Nearest(i);
    const bool known = information > 0.0F;
    const float units = known ? std::clamp(distance_m / kMetersPerUnit, -32767.0F, 32767.0F) : 0.0F;
    message.distance.push_back(static_cast<int16_t>(std::lround(units)));
    // Confidence on a logarithmic scale: 1 + 10 log2(information of one centimetre-grade beam).
    const float grade = known ? 1.0F + 10.0F * std::log2(1.0F + information * 1e-4F) : 0.0F;
    message.weight.push_back(static_cast<uint8_t>(std::min(grade, 255.0F)));
  }
  return message;
}

class Sdf2dAdapter : public PlanarSlam {
 public:
  explicit Sdf2dAdapter(const Sdf2dSlamOptions& options) : map_channel_(options.map_channel), pipeline_(options.slam) {
    pipeline_.SetStopwatch(MonotonicMs);
    if (options.load_map.empty()) return;
    const std::string error = LoadMap(options.load_map);
    if (!error.empty()) throw CommandError(ExitCode::kBadInput, error);
  }

  PlanarUpdate Process(const PlanarScan& scan, slam_diagnostics_t& diagnostics) override {
    const sdf2d::Result result = pipeline_.Process(scan);
    Describe(result, diagnostics);
    return {result.status != sdf2d::Status::kSkipped, result.utime, result.T_map_body, result.twist_body};
  }

  void AddOdometry(int64_t utime, const Pose2& T_odom_body) override { pipeline_.AddOdometry(utime, T_odom_body); }

  void SetMounting(const Pose2& T_body_lidar) override { pipeline_.SetMounting(T_body_lidar); }

  void Reset() override {
    pipeline_.Reset();
    published_revision_ = 0;
  }

  void SetPose(const Pose2& T_map_body) override { pipeline_.SetPose(T_map_body); }
  void SetLocalizeOnly(bool localize_only) override { pipeline_.SetLocalizeOnly(localize_only); }
  OccupancyGrid Grid() const override { return sdf2d::ToOccupancyGrid(pipeline_.map()); }
  std::string SaveMap(const std::string& stem) const override {
    return sdf2d::WriteMap(pipeline_.map(), stem + ".sdf");
  }

  std::string LoadMap(const std::string& path) override {
    std::string error;
    std::optional<sdf2d::SdfMap> map = sdf2d::ReadMap(path, &error);
    if (!map) return error;
    pipeline_.SetMap(std::move(*map));
    published_revision_ = 0;
    return "";
  }

  void PublishMap(ServiceContext& context, int64_t utime) override {
    if (map_channel_.empty()) return;
    const sdf2d::SdfMap& map = pipeline_.map();
    const auto publish = [&](const sdf2d::SdfTile& tile) {
      context.Publish(map_channel_, TileMessage(utime, map.cell_m(), tile));
    };
    for (const sdf2d::SdfTile& tile : map.tiles()) {
      if (tile.revision > published_revision_) publish(tile);
    }
    published_revision_ = map.revision();
    for (size_t i = 0; i < std::min(kTilesInTurn, map.tiles().size()); ++i)
      publish(map.tiles()[turn_++ % map.tiles().size()]);
  }

 private:
  std::string map_channel_;
  sdf2d::Pipeline pipeline_;
  uint64_t published_revision_ = 0;
  size_t turn_ = 0;
};

}  // namespace

std::unique_ptr<PlanarSlam> MakeAdapter(const Sdf2dSlamOptions& options) {
  return std::make_unique<Sdf2dAdapter>(options);
}

}  // namespace lcmslam
