#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "common/motion_input.h"
#include "common/slam_service.h"
#include "common/sweep_input.h"
#include "geometry/pose3.h"
#include "lidar/sweep.h"

namespace lcmslam {

// What one sweep did to a spatial SLAM system. Velocities and covariance in the map's axes.
struct SpatialUpdate {
  bool has_pose = false;  // false: the sweep was skipped
  int64_t utime = 0;      // us; of the pose, the sweep's last point
  Pose3 T_map_lidar;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();                            // m/s
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();                    // rad/s
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  // translation, rotation vector
};

// A SLAM algorithm on sweeps as SpatialSlamService drives it: an adapter from a library's pipeline. It knows the lidar
// only; the service moves everything to the body.
class SpatialSlam : public SlamSystem {
 public:
  // `motion`: since the sweep processed last. Fills status, iterations, counts and stages of `diagnostics`.
  virtual SpatialUpdate Process(const Sweep& sweep, const LidarMotion& motion, slam_diagnostics_t& diagnostics) = 0;
  virtual void SetPose(const Pose3& T_map_lidar) = 0;
};

struct SpatialSlamOptions : SlamServiceOptions {
  SpatialSlamOptions() { lidar_channel = "LIDAR_3D"; }

  std::string imu_channel;     // "": none. Readings in the body's axes
  Pose3 T_body_lidar;          // when mounting_configured
  Pose3 T_map_body_initial;    // of the first sweep
  std::string load_map;        // "": start with an empty map
  bool localize_only = false;  // never write into the map

  std::string Validate() const;
};

// A SLAM algorithm on sweeps, on the bus.
class SpatialSlamService : public SlamService {
 public:
  // Throws CommandError (kBadInput) when options.load_map cannot be read.
  SpatialSlamService(const SpatialSlamOptions& options, int64_t config_hash, std::unique_ptr<SpatialSlam> slam,
                     std::string name, ServiceContext& context);

 protected:
  void Flush() override { input_.Flush(); }
  void SetPose(const Pose3& T_map_body) override { slam_->SetPose(T_map_body * T_body_lidar_); }
  void Reset() override;

 private:
  void SetMounting(const Pose3& T_body_lidar);
  void OnSweep(const Sweep& sweep);
  PoseEstimate ToBody(const SpatialUpdate& update) const;
  Eigen::Matrix<double, 6, 6> CovarianceOfBody(const SpatialUpdate& update) const;
  Handled OnOdometry(const Event& event);
  Handled OnImu(const Event& event);

  Pose3 T_map_body_initial_;
  std::unique_ptr<SpatialSlam> slam_;
  SweepInput input_;
  MotionInput motion_;
  Pose3 T_body_lidar_;
  int64_t last_sweep_utime_ = 0;
};

}  // namespace lcmslam
