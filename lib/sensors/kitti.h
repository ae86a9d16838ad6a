#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/pose3.h"
#include "lidar/sweep.h"

namespace lcmslam {

// The files of the KITTI odometry benchmark and of KITTI's raw drives. All throw BadInput, texts with the line. Pure.

// velodyne/NNNNNN.bin: x, y, z, reflectance (0..1) as little-endian float32. Rings and times are unknown.
[[nodiscard]] std::vector<SweepPoint> DecodeKittiPoints(std::span<const uint8_t> file);

// times.txt: seconds, one a line; timestamps.txt of a raw drive: "2011-09-26 13:02:25.951199337", taken as UTC. Gives
// us, ascending or not.
[[nodiscard]] std::vector<int64_t> ParseKittiTimes(std::string_view text);

// poses.txt: the upper 3x4 of a transform, row by row, one a line. The rotation part is made orthonormal; one that is
// far from it is refused.
[[nodiscard]] std::vector<Pose3> ParseKittiPoses(std::string_view text);

// calib.txt: the transform of line "Tr:" (or "Tr_velo_cam:"), T_camera_lidar.
[[nodiscard]] Pose3 ParseKittiCalibration(std::string_view text);

// Gives raw sweeps, which are not compensated for motion, the times of their points by azimuth: a head that turns once
// in turn_s, clockwise from the back, and ends there at the sweep's utime. Halfway it looks ahead, which is when the
// stamps in timestamps.txt are taken.
void SetTimesByAzimuth(double turn_s, std::span<SweepPoint> points);

}  // namespace lcmslam
