#include "simulation/spatial_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lcmslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Eigen::Vector4d;

// Weights of four neighbouring control points at fraction u of their segment, and derivatives by u.
Vector4d Weights(double u) {
  const double v = 1.0 - u;
  return Vector4d(v * v * v, 3 * u * u * u - 6 * u * u + 4, 3 * v * v * v - 6 * v * v + 4, u * u * u) / 6.0;
}
Vector4d WeightRates(double u) {
  const double v = 1.0 - u;
  return Vector4d(-v * v, 3 * u * u - 4 * u, 4 * v - 3 * v * v, u * u) / 2.0;
}
Vector4d WeightAccelerations(double u) { return {1.0 - u, 3 * u - 2, 1 - 3 * u, u}; }

// Body rates of Rz(yaw) Ry(pitch) Rx(roll) from the rates of the angles.
Vector3d AngularVelocity(const Vector3d& angles, const Vector3d& rates) {
  const double sin_pitch = std::sin(angles[1]), cos_pitch = std::cos(angles[1]);
  const double sin_roll = std::sin(angles[2]), cos_roll = std::cos(angles[2]);
  return {rates[2] - rates[0] * sin_pitch, rates[1] * cos_roll + rates[0] * cos_pitch * sin_roll,
          -rates[1] * sin_roll + rates[0] * cos_pitch * cos_roll};
}

}  // namespace

SpatialMotion::SpatialMotion(double knot_interval_s, std::vector<MotionVector> control_points)
    : knot_interval_s_(knot_interval_s), control_points_(std::move(control_points)) {}

BodyState SpatialMotion::StateAt(double t_s) const {
  const double knot = std::clamp(t_s, 0.0, duration_s()) / knot_interval_s_;
  const size_t segment = std::min(static_cast<size_t>(knot), control_points_.size() - 4);
  const double u = knot - static_cast<double>(segment);
  Eigen::Matrix<double, 6, 4> control;
  for (int i = 0; i < 4; ++i) control.col(i) = control_points_[segment + static_cast<size_t>(i)];

  const MotionVector value = control * Weights(u);
  const MotionVector rate = control * WeightRates(u) / knot_interval_s_;
  const Vector3d angles = value.tail<3>();
  return {.T_world_body = {value.head<3>(), AngleAxisd(angles[0], Vector3d::UnitZ()) *
                                                AngleAxisd(angles[1], Vector3d::UnitY()) *
                                                AngleAxisd(angles[2], Vector3d::UnitX())},
          .velocity_mps = rate.head<3>(),
          .acceleration_mps2 = control.topRows<3>() * WeightAccelerations(u) / (knot_interval_s_ * knot_interval_s_),
          .angular_velocity_radps = AngularVelocity(angles, rate.tail<3>())};
}

}  // namespace lcmslam
