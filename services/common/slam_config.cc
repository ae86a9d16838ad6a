#include "common/slam_config.h"

#include <algorithm>
#include <cmath>

#include "common/planar_slam_service.h"
#include "common/spatial_slam_service.h"

namespace lcmslam {

void BindSharedChannels(ConfigBinder channels, SlamServiceOptions& options) {
  channels("lidar", options.lidar_channel)("odometry", options.odometry_channel)("command", options.command_channel);
  channels("pose", options.pose_channel)("diagnostics", options.diagnostics_channel);
}

void BindChannels(ConfigBinder channels, PlanarSlamOptions& options) {
  BindSharedChannels(channels, options);
  channels("grid", options.grid_channel);
  channels("grid_period_s", options.grid_period_s)("max_grid_cells", options.max_grid_cells);
}

void BindChannels(ConfigBinder channels, SpatialSlamOptions& options) {
  BindSharedChannels(channels, options);
  channels("imu", options.imu_channel);
}

void BindPose(ConfigBinder bind, Pose2& pose) {
  double x_m = pose.x(), y_m = pose.y(), yaw_rad = pose.yaw();
  bind("x_m", x_m)("y_m", y_m)("yaw_rad", yaw_rad);
  pose = Pose2(x_m, y_m, yaw_rad);
}

void BindPose(ConfigBinder bind, Pose3& pose) {
  Eigen::Vector3d& p = pose.translation;
  bind("x_m", p.x())("y_m", p.y())("z_m", p.z());
  const Eigen::Quaterniond& q = pose.rotation;
  double roll_rad = std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()), 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()));
  double pitch_rad = std::asin(std::clamp(2.0 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0));
  double yaw_rad = Yaw(q);
  bind("roll_rad", roll_rad)("pitch_rad", pitch_rad)("yaw_rad", yaw_rad);
  pose.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

}  // namespace lcmslam
