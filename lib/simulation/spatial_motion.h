#pragma once

#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"

namespace lcmslam {

inline constexpr double kGravity_mps2 = 9.80665;  // along -z of the world

// Where the body is and how it moves.
struct BodyState {
  Pose3 T_world_body;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();       // of the body's origin, world frame
  Eigen::Vector3d acceleration_mps2 = Eigen::Vector3d::Zero();  // of the body's origin, world frame, without gravity
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();  // body frame
};

// x, y, z (m) and yaw, pitch, roll (rad; rotation = Rz(yaw) Ry(pitch) Rx(roll)); angles are not wrapped.
using MotionVector = Eigen::Matrix<double, 6, 1>;

// A uniform cubic B-spline through space and attitude, known with its derivatives at every time: position and
// velocity are smooth, acceleration is continuous. The spline stays in the convex hull of each four
// neighbouring control points and never moves faster than the steps between them.
class SpatialMotion {
 public:
  // At least four control points, knot_interval_s > 0.
  SpatialMotion(double knot_interval_s, std::vector<MotionVector> control_points);

  double duration_s() const { return knot_interval_s_ * static_cast<double>(control_points_.size() - 3); }

  // Times outside [0, duration] are taken as its ends; the motion there is not zero.
  BodyState StateAt(double t_s) const;
  Pose3 PoseAt(double t_s) const { return StateAt(t_s).T_world_body; }

 private:
  double knot_interval_s_;
  std::vector<MotionVector> control_points_;
};

}  // namespace lcmslam
