#include "sdf2d/motion_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace lcmslam::sdf2d {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kReferenceInterval_s = 0.1;  // accelerations in the options are held for this long
constexpr size_t kMaxOdometry = 4096;

// Exp(Ad e) = T Exp(e) T^-1.
Matrix3d Adjoint(const Pose2& T) {
  Matrix3d ad = Matrix3d::Identity();
  ad.topLeftCorner<2, 2>() = T.rotation();
  ad(0, 2) = T.y();
  ad(1, 2) = -T.x();
  return ad;
}

Matrix3d StartTwistCovariance(const MotionOptions& options) {
  return Vector3d(options.start_speed, options.start_speed, options.start_turn_rate).cwiseAbs2().asDiagonal();
}

}  // namespace

Matrix3d MotionState::PoseCovarianceInMap() const {
  Matrix3d R_map_body = Matrix3d::Identity();
  R_map_body.topLeftCorner<2, 2>() = T_map_body.rotation();
  return R_map_body * covariance.topLeftCorner<3, 3>() * R_map_body.transpose();
}

MotionModel::MotionModel(const MotionOptions& options, const Pose2& T_map_body) : options_(options) {
  Restart(T_map_body);
}

void MotionModel::Restart(const Pose2& T_map_body) {
  state_ = MotionState{.T_map_body = T_map_body};
  state_.covariance.topLeftCorner<3, 3>() = StartPoseCovariance();
  state_.covariance.bottomRightCorner<3, 3>() = StartTwistCovariance(options_);
  started_ = false;
}

Matrix3d MotionModel::StartPoseCovariance() const {
  return Vector3d(options_.start_sigma_m, options_.start_sigma_m, options_.start_sigma_rad).cwiseAbs2().asDiagonal();
}

void MotionModel::Correct(int64_t utime, const MotionState& state) {
  state_ = state;
  utime_ = utime;
  started_ = true;
  while (odometry_.size() > 2 && odometry_[1].utime <= utime) odometry_.pop_front();
}

void MotionModel::AddOdometry(int64_t utime, const Pose2& T_odom_body) {
  if (!T_odom_body.IsFinite()) return;
  if (!odometry_.empty() && utime <= odometry_.back().utime) {
    if (SecondsBetween(utime, odometry_.back().utime) <= options_.max_gap_s) return;
    odometry_.clear();
  }
  if (odometry_.size() >= kMaxOdometry) odometry_.pop_front();
  odometry_.push_back({utime, T_odom_body});
}

// Between two stamps, or a little past the last one at the velocity of the last two.
std::optional<Pose2> MotionModel::OdometryAt(int64_t utime) const {
  const auto after = std::lower_bound(odometry_.begin(), odometry_.end(), utime,
                                      [](const Odometry& o, int64_t t) { return o.utime < t; });
  if (after != odometry_.end() && after->utime == utime) return after->T_odom_body;
  if (after == odometry_.begin()) return std::nullopt;
  const Odometry& before = *std::prev(after);
  const double since_s = SecondsBetween(before.utime, utime);
  if (since_s > options_.max_odometry_gap_s) return std::nullopt;
  if (after == odometry_.end()) {
    if (odometry_.size() < 2) return before.T_odom_body;
    const Odometry& earlier = *std::prev(after, 2);
    const Vector3d step = (earlier.T_odom_body.inverse() * before.T_odom_body).Log();
    return before.T_odom_body * Pose2::Exp(step * (since_s / SecondsBetween(earlier.utime, before.utime)));
  }
  return Interpolate(before.T_odom_body, after->T_odom_body, since_s / SecondsBetween(before.utime, after->utime));
}

double MotionModel::SecondsUntil(int64_t utime) const {
  const double dt_s = started_ ? SecondsBetween(utime_, utime) : 0.0;
  return dt_s > 0.0 && dt_s <= options_.max_gap_s ? dt_s : 0.0;
}

MotionState MotionModel::Predict(int64_t utime) const {
  MotionState predicted = state_;
  if (!started_) return predicted;
  if (!options_.predict) {
    predicted.twist_body.setZero();
    predicted.covariance.setZero();
    predicted.covariance.topLeftCorner<3, 3>() = StartPoseCovariance();
    predicted.covariance.bottomRightCorner<3, 3>() = StartTwistCovariance(options_);
    return predicted;
  }
  const double dt = SecondsBetween(utime_, utime);
  const std::optional<Pose2> from = OdometryAt(utime_);
  const std::optional<Pose2> to = OdometryAt(utime);

  if (from && to && dt > 0.0) {
    const Pose2 T_last_now = from->inverse() * *to;
    const Vector3d increment = T_last_now.Log();
    const Matrix3d back = Adjoint(T_last_now.inverse());
    const double sigma_m = options_.odometry_sigma_m + options_.odometry_slip * increment.head<2>().norm();
    const double sigma_rad = options_.odometry_sigma_rad + options_.odometry_slip * std::abs(increment.z());
    const Matrix3d noise = Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
    predicted.T_map_body = state_.T_map_body * T_last_now;
    predicted.twist_body = increment / dt;
    predicted.covariance.setZero();
    predicted.covariance.topLeftCorner<3, 3>() =
        back * state_.covariance.topLeftCorner<3, 3>() * back.transpose() + noise;
    predicted.covariance.bottomRightCorner<3, 3>() = noise / (dt * dt);
    return predicted;
  }

  if (!(dt > 0.0) || dt > options_.max_gap_s) {
    predicted.twist_body.setZero();
    predicted.covariance.setZero();
    const double pause = std::clamp(dt, options_.max_gap_s, 10.0 * options_.max_gap_s);
    predicted.covariance.bottomRightCorner<3, 3>() = StartTwistCovariance(options_);
    predicted.covariance.topLeftCorner<3, 3>() =
        state_.covariance.topLeftCorner<3, 3>() + pause * pause * StartTwistCovariance(options_);
    return predicted;
  }

  const Pose2 T_last_now = Pose2::Exp(state_.twist_body * dt);
  predicted.T_map_body = state_.T_map_body * T_last_now;
  Matrix6d F = Matrix6d::Identity();
  F.topLeftCorner<3, 3>() = Adjoint(T_last_now.inverse());
  F.topRightCorner<3, 3>() = dt * Matrix3d::Identity();
  const double linear = kReferenceInterval_s * options_.acceleration * options_.acceleration;
  const double angular = kReferenceInterval_s * options_.angular_acceleration * options_.angular_acceleration;
  const Matrix3d density = Vector3d(linear, linear, angular).asDiagonal();
  Matrix6d Q;
  Q << density * (dt * dt * dt / 3.0), density * (dt * dt / 2.0), density * (dt * dt / 2.0), density * dt;
  predicted.covariance = F * state_.covariance * F.transpose() + Q;
  return predicted;
}

}  // namespace lcmslam::sdf2d
