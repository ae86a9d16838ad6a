#include "common/planar_slam_config.h"

#include "common/planar_slam_service.h"

namespace lcmslam {

void BindChannels(ConfigBinder channels, PlanarSlamOptions& options) {
  channels("lidar", options.lidar_channel)("odometry", options.odometry_channel)("command", options.command_channel);
  channels("pose", options.pose_channel)("diagnostics", options.diagnostics_channel)("grid", options.grid_channel);
  channels("grid_period_s", options.grid_period_s)("max_grid_cells", options.max_grid_cells);
}

void BindPose(ConfigBinder bind, Pose2& pose) {
  double x_m = pose.x(), y_m = pose.y(), yaw_rad = pose.yaw();
  bind("x_m", x_m)("y_m", y_m)("yaw_rad", yaw_rad);
  pose = Pose2(x_m, y_m, yaw_rad);
}

}  // namespace lcmslam
