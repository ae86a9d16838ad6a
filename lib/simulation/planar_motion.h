#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose2.h"

namespace lcmslam {

// A body motion in steps of constant twist, hence known exactly at every time.
class PlanarMotion {
 public:
  // Body twists (vx, vy in m/s, yaw rate in rad/s; body frame), each held for step_us > 0.
  PlanarMotion(int64_t start_utime, int64_t step_us, const Pose2& T_world_body_start,
               std::vector<Eigen::Vector3d> twists);

  int64_t start_utime() const { return start_utime_; }
  int64_t end_utime() const { return start_utime_ + step_us_ * static_cast<int64_t>(twists_.size()); }

  // T_world_body; before the start and after the end the body stands still.
  Pose2 PoseAt(int64_t utime) const;
  // Body twist; zero before the start and from the end on.
  Eigen::Vector3d TwistAt(int64_t utime) const;

 private:
  int64_t start_utime_;
  int64_t step_us_;
  std::vector<Eigen::Vector3d> twists_;
  std::vector<Pose2> T_world_body_;  // at the beginning of each step, and at the end
};

}  // namespace lcmslam
