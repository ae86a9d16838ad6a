#include "geometry/pose2.h"

#include <cmath>

#include "geometry/angles.h"

namespace lcmslam {

Pose2::Pose2(double x_m, double y_m, double yaw_rad)
    : translation_(x_m, y_m), yaw_(WrapAngle(yaw_rad)), cos_(std::cos(yaw_rad)), sin_(std::sin(yaw_rad)) {}

Eigen::Matrix2d Pose2::rotation() const { return (Eigen::Matrix2d() << cos_, -sin_, sin_, cos_).finished(); }

Pose2 Pose2::inverse() const { return {-(cos_ * x() + sin_ * y()), sin_ * x() - cos_ * y(), -yaw_}; }

Pose2 Pose2::operator*(const Pose2& T_b_c) const { return {*this * T_b_c.translation_, yaw_ + T_b_c.yaw_}; }

Pose2 Pose2::Exp(const Eigen::Vector3d& twist) {
  const double w = twist.z();
  // sin(w)/w and (1 - cos(w))/w, by series where the quotient cancels.
  const bool small = std::abs(w) < 1e-4;
  const double a = small ? 1.0 - w * w / 6.0 : std::sin(w) / w;
  const double b = small ? w / 2.0 - w * w * w / 24.0 : (1.0 - std::cos(w)) / w;
  return {a * twist.x() - b * twist.y(), b * twist.x() + a * twist.y(), w};
}

Eigen::Vector3d Pose2::Log() const {
  const double half = 0.5 * yaw_;
  const double a = std::abs(half) < 1e-4 ? 1.0 - half * half / 3.0 : half / std::tan(half);
  return {a * x() + half * y(), a * y() - half * x(), yaw_};
}

bool Pose2::IsFinite() const { return translation_.allFinite() && std::isfinite(yaw_); }

Pose2 Interpolate(const Pose2& a, const Pose2& b, double fraction) {
  return {a.translation() + fraction * (b.translation() - a.translation()),
          a.yaw() + fraction * WrapAngle(b.yaw() - a.yaw())};
}

bool Reaches(const Pose2& motion, double distance_m, double angle_rad) {
  return motion.translation().norm() >= distance_m || std::abs(motion.yaw()) >= angle_rad;
}

}  // namespace lcmslam
