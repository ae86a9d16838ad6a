#pragma once

#include <cstdint>
#include <optional>

#include "geometry/pose2.h"
#include "geometry/trajectory.h"

namespace lcmslam::occupancy2d {

// What odometry says of the motion from scan to scan. Not thread-safe.
class OdometryGuess {
 public:
  // T_odom_body in any fixed frame; call before the scan it should help. Not finite or the same stamp again: dropped.
  // A stamp that jumps back starts afresh.
  void Add(int64_t utime, const Pose2& T_odom_body);

  // The motion T_before_now since the last call: identity where odometry does not reach within 0.25 s of both.
  Pose2 MotionUntil(int64_t utime);

 private:
  std::optional<Pose2> At(int64_t utime) const;

  Trajectory T_odom_body_;                   // from the last scan on
  std::optional<Pose2> T_odom_body_before_;  // at the last call
};

}  // namespace lcmslam::occupancy2d
