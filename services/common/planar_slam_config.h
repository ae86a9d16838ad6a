#pragma once

#include "common/config.h"
#include "geometry/pose2.h"

namespace lcmslam {

struct PlanarSlamOptions;

// The part of a planar system's configuration that PlanarSlamService needs: lidar, odometry, command, pose,
// diagnostics, grid, grid_period_s, max_grid_cells.
void BindChannels(ConfigBinder channels, PlanarSlamOptions& options);

// x_m, y_m, yaw_rad.
void BindPose(ConfigBinder bind, Pose2& pose);

}  // namespace lcmslam
