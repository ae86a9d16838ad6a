#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geometry/pose2.h"

namespace lcmslam {

// A rigid-body pose T_a_b in space: p_a = rotation * p_b + translation. Metres; the quaternion is kept at unit length.
struct Pose3 {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  Pose3 inverse() const;
  Pose3 operator*(const Pose3& T_b_c) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_b) const { return rotation * p_b + translation; }

  bool IsFinite() const { return translation.allFinite() && rotation.coeffs().allFinite(); }
  // Finite, with a quaternion of about unit length (0.01): whether numbers from outside can be a pose.
  bool IsRigid() const { return IsFinite() && std::abs(rotation.norm() - 1.0) <= 0.01; }
};

// Translation linear, rotation SLERP; fraction 0 is a, 1 is b.
Pose3 Interpolate(const Pose3& a, const Pose3& b, double fraction);

// z = roll = pitch = 0.
Pose3 ToPose3(const Pose2& pose);
// Drops z; the yaw is the heading of the body's x axis in the xy plane.
Pose2 ToPose2(const Pose3& pose);
double Yaw(const Eigen::Quaterniond& rotation);
// The angle between two rotations, in [0, pi].
double AngleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);
// Whether a motion is at least so long, or turns by at least so much.
bool Reaches(const Pose3& motion, double distance_m, double angle_rad);

}  // namespace lcmslam
