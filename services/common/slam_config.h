#pragma once

#include <string>

#include "common/config.h"
#include "geometry/pose2.h"
#include "geometry/pose3.h"

namespace lcmslam {

struct PlanarSlamOptions;
struct SpatialSlamOptions;

// The parts of a configuration that all SLAM services have: channels (by default NAME_POSE and NAME_DIAGNOSTICS),
// mounting where it is set, initial_pose; spatial ones localize_only, too.
void BindShell(ConfigBinder bind, const std::string& name, PlanarSlamOptions& options, Pose2& T_body_lidar,
               Pose2& T_map_body_initial);
void BindShell(ConfigBinder bind, const std::string& name, SpatialSlamOptions& options);

// x_m, y_m, yaw_rad.
void BindPose(ConfigBinder bind, Pose2& pose);
// x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad: R = Rz(yaw) Ry(pitch) Rx(roll).
void BindPose(ConfigBinder bind, Pose3& pose);

}  // namespace lcmslam
