#include "geometry/pose3.h"

#include <cmath>

namespace lcmslam {

Pose3 Pose3::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
  return {-(inverse_rotation * translation), inverse_rotation};
}

Pose3 Pose3::operator*(const Pose3& T_b_c) const {
  return {*this * T_b_c.translation, (rotation * T_b_c.rotation).normalized()};
}

Pose3 Interpolate(const Pose3& a, const Pose3& b, double fraction) {
  return {a.translation + fraction * (b.translation - a.translation), a.rotation.slerp(fraction, b.rotation)};
}

Pose3 ToPose3(const Pose2& pose) {
  return {{pose.x(), pose.y(), 0.0}, Eigen::Quaterniond(Eigen::AngleAxisd(pose.yaw(), Eigen::Vector3d::UnitZ()))};
}

Pose2 ToPose2(const Pose3& pose) { return {pose.translation.x(), pose.translation.y(), Yaw(pose.rotation)}; }

double Yaw(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

double AngleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond d = a.conjugate() * b;
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

bool Reaches(const Pose3& motion, double distance_m, double angle_rad) {
  return motion.translation.norm() >= distance_m ||
         AngleBetween(motion.rotation, Eigen::Quaterniond::Identity()) >= angle_rad;
}

}  // namespace lcmslam
