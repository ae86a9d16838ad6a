#include <lcmslam/slam_diagnostics_t.hpp>

#include "common/diagnostics.h"
#include "occupancy2d-slam/occupancy2d_slam.h"

namespace lcmslam {
namespace {

void Describe(const occupancy2d::Result& result, slam_diagnostics_t& diagnostics) {
  diagnostics.status = static_cast<int8_t>(result.status);
  diagnostics.iterations = result.iterations;
  diagnostics.num_points = result.num_points;
  diagnostics.inlier_ratio = static_cast<float>(result.inlier_ratio);
  diagnostics.residual_rms = static_cast<float>(result.residual_rms_m);
  SetCovariance(result.covariance, diagnostics);
  SetStages(occupancy2d::kStageNames, result.stage_ms, diagnostics);
}

class Occupancy2dAdapter : public PlanarSlam {
 public:
  explicit Occupancy2dAdapter(const occupancy2d::Options& options) : pipeline_(options) {
    pipeline_.SetStopwatch(MonotonicMs);
  }

  PlanarUpdate Process(const PlanarScan& scan, slam_diagnostics_t& diagnostics) override {
    const occupancy2d::Result result = pipeline_.Process(scan);
    Describe(result, diagnostics);
    return {.has_pose = result.status != occupancy2d::Status::kSkipped,
            .utime = result.utime,
            .T_map_body = result.T_map_body};
  }

  void AddOdometry(int64_t utime, const Pose2& T_odom_body) override { pipeline_.AddOdometry(utime, T_odom_body); }
  void SetMounting(const Pose2& T_body_lidar) override { pipeline_.SetMounting(T_body_lidar); }
  void Reset() override { pipeline_.Reset(); }
  void SetPose(const Pose2& T_map_body) override { pipeline_.SetPose(T_map_body); }
  void SetLocalizeOnly(bool localize_only) override { pipeline_.SetLocalizeOnly(localize_only); }

  // The grid that PlanarSlamService publishes and writes is the whole map.
  OccupancyGrid Grid() const override { return pipeline_.map().ToOccupancyGrid(); }
  std::string SaveMap(const std::string&) const override { return ""; }
  std::string LoadMap(const std::string& path) override { return path + ": occupancy2d-slam loads no maps"; }
  void PublishMap(ServiceContext&, int64_t) override {}

 private:
  occupancy2d::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<PlanarSlam> MakeAdapter(const Occupancy2dSlamOptions& options) {
  return std::make_unique<Occupancy2dAdapter>(options.slam);
}

}  // namespace lcmslam
