#pragma once

#include <filesystem>
#include <string>

#include "geometry/trajectory.h"

namespace lcmslam {

enum class TrajectoryFormat {
  kAuto,    // told apart by separator and number of columns
  kTum,     // timestamp tx ty tz qx qy qz qw         s, m
  kPlanar,  // timestamp x y yaw                      s, m, rad
  kEuroc,   // timestamp,px,py,pz,qw,qx,qy,qz[,...]   ns, m
  kKitti,   // the 12 numbers of a row-major 3x4 T_world_body; stamps stand in a file of their own, in s
};

struct ReadOptions {
  TrajectoryFormat format = TrajectoryFormat::kAuto;
  std::filesystem::path kitti_times = {};  // one stamp a line; none: poses are kitti_period_us apart, from 0
  int64_t kitti_period_us = 100'000;
};

struct TrajectoryFile {
  Trajectory trajectory;  // empty on error
  std::string error;      // "" or "FILE:LINE: reason"
};

// Reads a trajectory of text lines; # starts a comment line. An error is: a file that does not open or holds no pose,
// another number of columns, a number that is not finite, stamps that do not increase (at 1 us), a quaternion more
// than 5 % off unit length or a matrix more than 1 % off a rotation; smaller deviations are normalized away.
[[nodiscard]] TrajectoryFile ReadTrajectory(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace lcmslam
