#pragma once

#include "common/config.h"
#include "geometry/pose2.h"
#include "geometry/pose3.h"

namespace lcmslam {

struct PlanarSlamOptions;
struct SlamServiceOptions;
struct SpatialSlamOptions;

// The parts of a configuration that the shells of SLAM services need.

// lidar, odometry, command, pose, diagnostics.
void BindSharedChannels(ConfigBinder channels, SlamServiceOptions& options);
// lidar, odometry, command, pose, diagnostics, grid, grid_period_s, max_grid_cells.
void BindChannels(ConfigBinder channels, PlanarSlamOptions& options);
// lidar, odometry, imu, command, pose, diagnostics.
void BindChannels(ConfigBinder channels, SpatialSlamOptions& options);

// x_m, y_m, yaw_rad.
void BindPose(ConfigBinder bind, Pose2& pose);
// x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad: R = Rz(yaw) Ry(pitch) Rx(roll).
void BindPose(ConfigBinder bind, Pose3& pose);

}  // namespace lcmslam
