#include <fstream>
#include <functional>

#include <lcmslam/slam_diagnostics_t.hpp>

#include "common/diagnostics.h"
#include "octo3d-slam/octo3d_slam.h"
#include "octo3d-slam/surfel_publisher.h"
#include "octo3d/map_file.h"
#include "octo3d/pipeline.h"

namespace lcmslam {
namespace {

using octo3d::SweepStatus;

int8_t StatusOnTheBus(const octo3d::Result& result) {
  switch (result.status) {
    case SweepStatus::kStarted:
      return slam_diagnostics_t::INITIALIZING;
    case SweepStatus::kTracking:
      if (result.searched) return slam_diagnostics_t::RELOCALIZED;
      return result.unobservable.cols() > 0 ? slam_diagnostics_t::DEGENERATE : slam_diagnostics_t::TRACKING;
    case SweepStatus::kStale:
      return slam_diagnostics_t::SKIPPED;
    case SweepStatus::kDoubtful:
    case SweepStatus::kNoPoints:
      break;
  }
  return slam_diagnostics_t::LOST;
}

void Describe(const octo3d::Result& result, double range_noise_m, slam_diagnostics_t& diagnostics) {
  diagnostics.status = StatusOnTheBus(result);
  diagnostics.iterations = result.iterations;
  diagnostics.num_points = result.patches;
  diagnostics.inlier_ratio = static_cast<float>(result.inlier_ratio);
  diagnostics.residual_rms = static_cast<float>(result.residual_m);
  diagnostics.range_sigma = static_cast<float>(range_noise_m);
  for (Eigen::Index i = 0; i < result.unobservable.cols(); ++i) {
    Eigen::Index axis = 0;
    result.unobservable.col(i).cwiseAbs().maxCoeff(&axis);
    diagnostics.unobservable |= 1 << axis;
  }
  SetStages(octo3d::kStageNames, result.stage_ms, diagnostics);
}

// "" or the reason.
std::string WriteFile(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream file(path, std::ios::binary);
  write(file);
  return file.flush() ? "" : path + ": cannot be written";
}

class Octo3dAdapter : public SpatialSlam {
 public:
  explicit Octo3dAdapter(const Octo3dSlamOptions& options)
      : occupancy_(options.occupancy), pipeline_(options.slam), publisher_(options.map_channel) {
    pipeline_.SetStopwatch(MonotonicMs);
  }

  SpatialUpdate Process(const Sweep& sweep, const LidarMotion& motion, slam_diagnostics_t& diagnostics) override {
    const octo3d::Result result = pipeline_.Process(sweep, {motion.rotation, motion.odometry});
    if (result.began_anew) publisher_.Restart();
    Describe(result, pipeline_.map().options().range_noise_m, diagnostics);
    return {.has_pose = result.status != SweepStatus::kStale,
            .utime = result.utime,
            .T_map_lidar = result.T_map_body,
            .velocity = result.velocity,
            .angular_velocity = result.angular_velocity,
            .covariance = result.covariance};
  }

  void Reset() override {
    pipeline_.Reset();
    publisher_.Restart();
  }

  void SetPose(const Pose3& T_map_lidar) override { pipeline_.SetPose(T_map_lidar); }
  void SetLocalizeOnly(bool localize_only) override { pipeline_.SetLocalizeOnly(localize_only); }

  std::string SaveMap(const std::string& stem) const override {
    const octo3d::SurfelMap& map = pipeline_.map();
    for (const std::string& error :
         {WriteFile(stem + ".surfels", [&](std::ostream& out) { octo3d::WriteMap(map, out); }),
          WriteFile(stem + ".ply", [&](std::ostream& out) { octo3d::WritePly(map.ChangedSince(0), out); }),
          WriteFile(stem + ".ot", [&](std::ostream& out) { octo3d::WriteOt(map, occupancy_, out); }),
          WriteFile(stem + ".bt", [&](std::ostream& out) { octo3d::WriteBt(map, occupancy_, out); })}) {
      if (!error.empty()) return error;
    }
    return "";
  }

  std::string LoadMap(const std::string& path) override {
    std::ifstream file(path, std::ios::binary);
    if (!file) return path + ": cannot be read";
    octo3d::ReadMapResult read = octo3d::ReadMap(file);
    if (!read.map) return path + ": " + read.error;
    pipeline_.SetMap(std::move(*read.map));
    publisher_.Restart();
    return "";
  }

  void PublishMap(ServiceContext& context, int64_t utime) override {
    publisher_.Publish(pipeline_.map(), utime, context);
  }

 private:
  octo3d::OccupancyExportOptions occupancy_;
  octo3d::Pipeline pipeline_;
  SurfelPublisher publisher_;
};

}  // namespace

std::unique_ptr<SpatialSlam> MakeAdapter(const Octo3dSlamOptions& options) {
  return std::make_unique<Octo3dAdapter>(options);
}

}  // namespace lcmslam
