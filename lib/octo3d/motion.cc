#include "octo3d/motion.h"

#include <cmath>

namespace lcmslam::octo3d {

Eigen::Quaterniond ExpRotation(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  // sin(a/2)/a by its series near zero
  const double scale = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return Eigen::Quaterniond(std::cos(0.5 * angle), scale * v.x(), scale * v.y(), scale * v.z()).normalized();
}

Eigen::Vector3d LogRotation(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // the short way round
  const double sine = q.vec().norm();
  const double scale = sine < 1e-9 ? 2.0 : 2.0 * std::atan2(sine, sign * q.w()) / sine;
  return sign * scale * q.vec();
}

MotionState Add(const MotionState& state, const Vector12& delta) {
  MotionState sum = state;
  sum.T_map_body.translation += delta.segment<3>(0);
  sum.T_map_body.rotation = (ExpRotation(delta.segment<3>(3)) * state.T_map_body.rotation).normalized();
  sum.velocity += delta.segment<3>(6);
  sum.angular_velocity += delta.segment<3>(9);
  return sum;
}

Vector12 Difference(const MotionState& a, const MotionState& b) {
  Vector12 delta;
  delta << a.T_map_body.translation - b.T_map_body.translation,
      LogRotation(a.T_map_body.rotation * b.T_map_body.rotation.conjugate()), a.velocity - b.velocity,
      a.angular_velocity - b.angular_velocity;
  return delta;
}

MotionState Extrapolate(const MotionState& state, double dt_s) {
  Vector12 delta = Vector12::Zero();
  delta << dt_s * state.velocity, dt_s * state.angular_velocity, Eigen::Matrix<double, 6, 1>::Zero();
  return Add(state, delta);
}

MotionSegment::MotionSegment(const MotionState& from, const MotionState& to, double duration_s)
    : from_(from),
      to_(to),
      duration_s_(duration_s),
      turn_(LogRotation(to.T_map_body.rotation * from.T_map_body.rotation.conjugate())),
      // the inverse left Jacobian of the rotation vector, to first order
      turn_rate_to_(to.angular_velocity - 0.5 * turn_.cross(to.angular_velocity)) {}

Eigen::Vector4d MotionSegment::Influence(double s) const {
  const double s2 = s * s, s3 = s2 * s;
  return {2.0 * s3 - 3.0 * s2 + 1.0, duration_s_ * (s3 - 2.0 * s2 + s), 3.0 * s2 - 2.0 * s3, duration_s_ * (s3 - s2)};
}

Pose3 MotionSegment::At(double fraction) const {
  const Eigen::Vector4d h = Influence(fraction);
  const Eigen::Vector3d translation = h[0] * from_.T_map_body.translation + h[1] * from_.velocity +
                                      h[2] * to_.T_map_body.translation + h[3] * to_.velocity;
  const Eigen::Vector3d turn = h[1] * from_.angular_velocity + h[2] * turn_ + h[3] * turn_rate_to_;
  return {translation, (ExpRotation(turn) * from_.T_map_body.rotation).normalized()};
}

MotionPrior EvaluateMotionPrior(const MotionSegment& segment, double acceleration_mps2, double acceleration_radps2) {
  const double dt = segment.duration_s();
  MotionPrior prior;
  prior.error = Difference(segment.to(), Extrapolate(segment.from(), dt));
  prior.transition.setIdentity();
  prior.transition.block<6, 6>(0, 6) = dt * Matrix6::Identity();
  // Power spectral density q, covariance q [dt^3/3 dt^2/2; dt^2/2 dt]; q dt = (a dt)^2.
  Vector6 inverse_q;
  inverse_q.head<3>().setConstant(1.0 / (acceleration_mps2 * acceleration_mps2 * dt));
  inverse_q.tail<3>().setConstant(1.0 / (acceleration_radps2 * acceleration_radps2 * dt));
  prior.information.setZero();
  prior.information.topLeftCorner<6, 6>().diagonal() = 12.0 / (dt * dt * dt) * inverse_q;
  prior.information.topRightCorner<6, 6>().diagonal() = -6.0 / (dt * dt) * inverse_q;
  prior.information.bottomLeftCorner<6, 6>().diagonal() = -6.0 / (dt * dt) * inverse_q;
  prior.information.bottomRightCorner<6, 6>().diagonal() = 4.0 / dt * inverse_q;
  return prior;
}

}  // namespace lcmslam::octo3d
