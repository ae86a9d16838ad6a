#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "sdf2d/options.h"

namespace lcmslam::sdf2d {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Of any two stamps, without overflow.
inline double SecondsBetween(int64_t from_utime, int64_t to_utime) {
  return 1e-6 * (static_cast<double>(to_utime) - static_cast<double>(from_utime));
}

// Pose, velocity, and how well they are known. Errors are taken in the body frame: T = T_map_body Exp(e.head(3)),
// twist = twist_body + e.tail(3).
struct MotionState {
  Pose2 T_map_body;
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s
  Matrix6d covariance = Matrix6d::Zero();                // of e

  // x, y, yaw of the pose; map axes, about the body's origin.
  Eigen::Matrix3d PoseCovarianceInMap() const;
};

// Where the body should be: constant velocity disturbed by white acceleration, or odometry increments where there are
// any.
class MotionModel {
 public:
  MotionModel(const MotionOptions& options, const Pose2& T_map_body);

  const MotionState& state() const { return state_; }
  int64_t utime() const { return utime_; }
  bool started() const { return started_; }

  // Stamps must rise; others are dropped, unless they jump back by more than max_gap_s, which starts afresh.
  void AddOdometry(int64_t utime, const Pose2& T_odom_body);

  // Since the last corrected state; 0 when there is none, or none of use any more.
  double SecondsUntil(int64_t utime) const;
  // The state at `utime`, from the last corrected one. Does not change this object.
  MotionState Predict(int64_t utime) const;
  // The state at `utime` is now known to be `state`.
  void Correct(int64_t utime, const MotionState& state);
  // Continues from a pose with an unknown velocity.
  void Restart(const Pose2& T_map_body);

 private:
  struct Odometry {
    int64_t utime;
    Pose2 T_odom_body;
  };
  Eigen::Matrix3d StartPoseCovariance() const;
  std::optional<Pose2> OdometryAt(int64_t utime) const;

  MotionOptions options_;
  MotionState state_;
  int64_t utime_ = 0;
  bool started_ = false;
  std::deque<Odometry> odometry_;
};

}  // namespace lcmslam::sdf2d
