#include <fstream>

#include <lcmslam/slam_diagnostics_t.hpp>

#include "cloud3d-slam/cloud3d_slam.h"
#include "common/diagnostics.h"

namespace lcmslam {
namespace {

void Describe(const cloud3d::Result& result, slam_diagnostics_t& diagnostics) {
  diagnostics.status = static_cast<int8_t>(result.status);
  diagnostics.iterations = result.iterations;
  diagnostics.num_points = result.num_points;
  diagnostics.inlier_ratio = static_cast<float>(result.inlier_ratio);
  diagnostics.residual_rms = static_cast<float>(result.residual_rms_m);
  SetStages(cloud3d::kStageNames, result.stage_ms, diagnostics);
}

class Cloud3dAdapter : public SpatialSlam {
 public:
  explicit Cloud3dAdapter(const cloud3d::Options& options) : pipeline_(options) { pipeline_.SetStopwatch(MonotonicMs); }

  SpatialUpdate Process(const Sweep& sweep, const LidarMotion& motion, slam_diagnostics_t& diagnostics) override {
    const cloud3d::Result result = pipeline_.Process(sweep, motion.odometry);
    Describe(result, diagnostics);
    return {.has_pose = result.status != cloud3d::Status::kSkipped,
            .utime = result.utime,
            .T_map_lidar = result.T_map_body,
            .velocity = result.velocity,
            .angular_velocity = result.angular_velocity,
            .covariance = result.covariance};
  }

  void Reset() override { pipeline_.Reset(); }
  void SetPose(const Pose3& T_map_lidar) override { pipeline_.SetPose(T_map_lidar); }
  void SetLocalizeOnly(bool localize_only) override { pipeline_.SetLocalizeOnly(localize_only); }

  std::string SaveMap(const std::string& stem) const override {
    std::ofstream file(stem + ".ply", std::ios::binary);
    WritePly(pipeline_.map(), file);
    return file.flush() ? "" : stem + ".ply: cannot be written";
  }
  std::string LoadMap(const std::string& path) override { return path + ": cloud3d-slam loads no maps"; }
  void PublishMap(ServiceContext&, int64_t) override {}

 private:
  cloud3d::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<SpatialSlam> MakeAdapter(const Cloud3dSlamOptions& options) {
  return std::make_unique<Cloud3dAdapter>(options.slam);
}

}  // namespace lcmslam
