#pragma once

#include <Eigen/Core>

namespace lcmslam {

// A planar rigid-body pose T_a_b: maps points of frame b into frame a. Metres, radians, counter-clockwise.
class Pose2 {
 public:
  Pose2() = default;
  Pose2(double x_m, double y_m, double yaw_rad);
  Pose2(const Eigen::Vector2d& translation_m, double yaw_rad) : Pose2(translation_m.x(), translation_m.y(), yaw_rad) {}

  double x() const { return translation_.x(); }
  double y() const { return translation_.y(); }
  double yaw() const { return yaw_; }  // in [-pi, pi]
  double cos() const { return cos_; }
  double sin() const { return sin_; }
  const Eigen::Vector2d& translation() const { return translation_; }
  Eigen::Matrix2d rotation() const;

  Pose2 inverse() const;
  Pose2 operator*(const Pose2& T_b_c) const;
  Eigen::Vector2d operator*(const Eigen::Vector2d& p_b) const {
    return {translation_.x() + cos_ * p_b.x() - sin_ * p_b.y(), translation_.y() + sin_ * p_b.x() + cos_ * p_b.y()};
  }

  // The group exponential of a twist (vx, vy, omega) held for one unit of time, and its inverse.
  static Pose2 Exp(const Eigen::Vector3d& twist);
  Eigen::Vector3d Log() const;

  bool IsFinite() const;

 private:
  Eigen::Vector2d translation_ = Eigen::Vector2d::Zero();
  double yaw_ = 0.0;
  double cos_ = 1.0;
  double sin_ = 0.0;
};

// From a (fraction 0) to b (fraction 1): translation linear, yaw the short way round. Extrapolates outside [0, 1].
Pose2 Interpolate(const Pose2& a, const Pose2& b, double fraction);

// Whether a motion is at least so long, or turns by at least so much.
bool Reaches(const Pose2& motion, double distance_m, double angle_rad);

}  // namespace lcmslam
