#pragma once

#include <Eigen/Core>

#include "geometry/pose3.h"

namespace lcmslam::octo3d {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

// Exponential and logarithm of rotations (rotation vectors, radians).
Eigen::Quaterniond ExpRotation(const Eigen::Vector3d& rotation_vector);
Eigen::Vector3d LogRotation(const Eigen::Quaterniond& rotation);

// Where the body is and how it moves, all in the map frame.
struct MotionState {
  Pose3 T_map_body;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          // m/s
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // rad/s
};

// Error coordinates of a state: translation, rotation (both added on the map side), velocity, angular velocity.
MotionState Add(const MotionState& state, const Vector12& delta);
Vector12 Difference(const MotionState& a, const MotionState& b);  // Add(b, Difference(a, b)) == a

// Constant velocity for dt_s.
MotionState Extrapolate(const MotionState& state, double dt_s);

// The motion between two states: cubic Hermite in translation and in the rotation vector from the first pose, which is
// the posterior mean of a white-noise-on-acceleration prior (Barfoot, State Estimation for Robotics, ch. 11).
class MotionSegment {
 public:
  MotionSegment() = default;
  // duration_s > 0.
  MotionSegment(const MotionState& from, const MotionState& to, double duration_s);

  // fraction 0: from; 1: to. Extrapolates a little outside.
  Pose3 At(double fraction) const;

  // How perturbations (pose from, velocity from, pose to, velocity to) add up to the perturbation of At(fraction).
  Eigen::Vector4d Influence(double fraction) const;

  const MotionState& from() const { return from_; }
  const MotionState& to() const { return to_; }
  double duration_s() const { return duration_s_; }

 private:
  MotionState from_, to_;
  double duration_s_ = 1.0;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();          // rotation vector from -> to
  Eigen::Vector3d turn_rate_to_ = Eigen::Vector3d::Zero();  // its derivative at `to`, rad/s
};

// The white-noise-on-acceleration prior between two states: error e (12) and information W (12 x 12, block structured
// by axis); cost e^T W e. de/d(delta to) = I, de/d(delta from) = -Transition.
struct MotionPrior {
  Vector12 error;
  Matrix12 information;
  Matrix12 transition;
};
// acceleration: m/s^2, rad/s^2: the standard deviation of the velocity's change over duration_s, divided by duration_s.
MotionPrior EvaluateMotionPrior(const MotionSegment& segment, double acceleration_mps2, double acceleration_radps2);

}  // namespace lcmslam::octo3d
