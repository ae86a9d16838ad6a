#include "common/slam_config.h"

#include <algorithm>
#include <cmath>

#include "common/planar_slam_service.h"
#include "common/spatial_slam_service.h"

namespace lcmslam {
namespace {

template <class Pose>
void BindShared(ConfigBinder bind, const std::string& name, SlamServiceOptions& options, Pose& T_body_lidar,
                Pose& T_map_body_initial) {
  options.pose_channel = name + "_POSE";
  options.diagnostics_channel = name + "_DIAGNOSTICS";
  ConfigBinder channels = bind.Sub("channels");
  channels("lidar", options.lidar_channel)("odometry", options.odometry_channel)("command", options.command_channel);
  channels("pose", options.pose_channel)("diagnostics", options.diagnostics_channel);
  options.mounting_configured = bind.Has("mounting");
  if (options.mounting_configured) BindPose(bind.Sub("mounting"), T_body_lidar);
  BindPose(bind.Sub("initial_pose"), T_map_body_initial);
}

}  // namespace

void BindShell(ConfigBinder bind, const std::string& name, PlanarSlamOptions& options, Pose2& T_body_lidar,
               Pose2& T_map_body_initial) {
  BindShared(bind, name, options, T_body_lidar, T_map_body_initial);
  ConfigBinder channels = bind.Sub("channels");
  channels("grid", options.grid_channel);
  channels("grid_period_s", options.grid_period_s)("max_grid_cells", options.max_grid_cells);
}

void BindShell(ConfigBinder bind, const std::string& name, SpatialSlamOptions& options) {
  BindShared(bind, name, options, options.T_body_lidar, options.T_map_body_initial);
  bind("localize_only", options.localize_only);
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
