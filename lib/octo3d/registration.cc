#include "octo3d/registration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "lidar/pose_table.h"
#include "octo3d/plane_constraints.h"
#include "octo3d/sweep_information.h"

namespace lcmslam::octo3d {

namespace {

using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Vector24 = Eigen::Matrix<double, 24, 1>;

// The information about `to` alone: Schur complement.
Matrix12 MarginalizeFrom(const Matrix24& H) {
  const Matrix12 H_to_from = H.bottomLeftCorner<12, 12>();
  const Matrix12 schur =
      H.bottomRightCorner<12, 12>() - H_to_from * H.topLeftCorner<12, 12>().ldlt().solve(H_to_from.transpose());
  return 0.5 * (schur + schur.transpose());
}

class Registrar {
 public:
  Registrar(const SurfelMap& map, const TimedPatches& sweep, const StateBelief& from, const RelativeMotion& hint,
            const MotionSegment& guess, const RegistrationOptions& options)
      : sweep_(sweep),
        belief_(from),
        hint_(hint),
        guess_(guess),
        options_(options),
        slots_(sweep.first_dt_us),
        constraints_(map, sweep.patches, options, guess.to().T_map_body.translation) {}

  RegistrationResult Run() {
    Predict();
    for (result_.iterations = 1; result_.iterations <= options_.max_iterations; ++result_.iterations) {
      const double sweep_us = 1e6 * sweep_.duration_s;
      const PoseTable poses(slots_, [&](double dt_us) { return result_.motion.At(1.0 + dt_us / sweep_us); });
      Linearize(poses);
      if (result_.matched < kMinMatches) break;
      const bool small = Step();
      const bool narrow = kernel_floor_m_ <= 0.0;
      kernel_floor_m_ = kernel_floor_m_ > kNarrowM ? 0.4 * kernel_floor_m_ : 0.0;
      if (small && narrow) {
        result_.status = RegistrationStatus::kConverged;
        break;
      }
      result_.status = RegistrationStatus::kIterationLimit;
    }
    result_.iterations = std::min(result_.iterations, options_.max_iterations);
    Summarize();
    return result_;
  }

 private:
  void Predict();
  void Linearize(const PoseTable& poses);
  void AddPriors(Matrix24& H, Vector24& b) const;
  bool Step();
  void Summarize();
  Directions Unobservable();

  static constexpr int kMinMatches = 12;  // twice the unknowns of a pose
  static constexpr double kNarrowM = 0.02;

  const TimedPatches& sweep_;
  const StateBelief& belief_;
  const RelativeMotion& hint_;
  const MotionSegment& guess_;
  const RegistrationOptions& options_;

  const TimeSlots slots_;
  PlaneConstraints constraints_;
  SweepInformation measured_;
  Matrix24 H_ = Matrix24::Zero();
  double kernel_floor_m_ = 0.0;
  RegistrationResult result_;
};

void Registrar::Predict() {
  result_.motion = PredictMotion(belief_, hint_, sweep_.duration_s);
  Matrix24 H = Matrix24::Zero();
  Vector24 b = Vector24::Zero();
  AddPriors(H, b);
  result_.prediction = {result_.motion.to(), MarginalizeFrom(H)};

  // How far off the prediction may be decides how far the first look reaches.
  const Vector6 spread = result_.prediction.information.ldlt().solve(Matrix12::Identity()).diagonal().head<6>();
  constexpr double kLever = 3.0;  // m
  kernel_floor_m_ = 2.0 * std::sqrt(spread.head<3>().mean() + kLever * kLever * spread.tail<3>().mean());
  result_.motion = guess_;
}

void Registrar::Linearize(const PoseTable& poses) {
  measured_.Clear();
  const ConstraintFit fit = constraints_.AddTo(measured_, poses, kernel_floor_m_);
  result_.matched = fit.matched;
  result_.inlier_ratio = fit.matched > 0 ? static_cast<double>(fit.inliers) / fit.matched : 0.0;
  result_.residual_m = fit.inliers > 0 ? std::sqrt(fit.squares / fit.inliers) : 0.0;
  result_.normalized_residual = fit.inliers > 0 ? std::sqrt(fit.normalized / fit.inliers) : 0.0;
}

void Registrar::AddPriors(Matrix24& H, Vector24& b) const {
  H.topLeftCorner<12, 12>() += belief_.information;
  b.head<12>() += belief_.information * Difference(result_.motion.from(), belief_.mean);

  const MotionPrior prior =
      EvaluateMotionPrior(result_.motion, options_.acceleration_mps2, options_.angular_acceleration_radps2);
  Eigen::Matrix<double, 12, 24> J;
  J << -prior.transition, Matrix12::Identity();
  H += J.transpose() * prior.information * J;
  b += J.transpose() * (prior.information * prior.error);

  if (hint_.information.isZero()) return;
  const Pose3& from = result_.motion.from().T_map_body;
  const Pose3 expected = from * hint_.T_from_to;
  const Pose3& to = result_.motion.to().T_map_body;
  Vector6 error;
  error << to.translation - expected.translation, LogRotation(to.rotation * expected.rotation.conjugate());
  const Matrix6 W = hint_.information.asDiagonal();
  Eigen::Matrix<double, 6, 24> J_hint = Eigen::Matrix<double, 6, 24>::Zero();
  J_hint.block<6, 6>(0, 0) = -Matrix6::Identity();
  J_hint.block<6, 6>(0, 12) = Matrix6::Identity();
  H += J_hint.transpose() * W * J_hint;
  b += J_hint.transpose() * (W * error);
}

// One Gauss-Newton step; true when it is small beside what the states are uncertain by (Newton's decrement).
bool Registrar::Step() {
  H_.setZero();
  Vector24 b = Vector24::Zero();
  measured_.AddTo(result_.motion, slots_, H_, b);
  AddPriors(H_, b);
  const Vector24 delta = -H_.ldlt().solve(b);
  result_.motion = MotionSegment(Add(result_.motion.from(), delta.head<12>()),
                                 Add(result_.motion.to(), delta.tail<12>()), sweep_.duration_s);
  return -delta.dot(b) < options_.step_sigmas * options_.step_sigmas;
}

void Registrar::Summarize() {
  if (result_.status == RegistrationStatus::kTooFewPatches) {
    result_.belief = result_.prediction;
    return;
  }
  result_.belief = {result_.motion.to(), MarginalizeFrom(H_)};
  result_.measured = measured_.Total();
  result_.unobservable = Unobservable();
}

// What a sweep does not show, the noise of the normals shows a little: level beams on the walls of a room seem to tell
// of height, a corridor's walls of its length.
Directions Registrar::Unobservable() {
  constexpr double kDoubtful = 30.0;  // times the least share: beyond, the noise is of no account
  constexpr double kNoise = 4.0;      // how far the noise may exceed its expectation
  const double share = options_.min_direction_share;
  if (UnobservableDirections(result_.measured, kDoubtful * share).cols() == 0) return Directions(6, 0);
  return UnobservableDirections(result_.measured, share, kNoise * constraints_.NoiseOfNormals(kernel_floor_m_));
}

}  // namespace

MotionSegment PredictMotion(const StateBelief& from, const RelativeMotion& hint, double duration_s) {
  MotionState to = Extrapolate(from.mean, duration_s);
  const Pose3 hinted = from.mean.T_map_body * hint.T_from_to;
  if (hint.information[0] > 0.0) to.T_map_body.translation = hinted.translation;
  if (hint.information[3] > 0.0) to.T_map_body.rotation = hinted.rotation;
  return MotionSegment(from.mean, to, duration_s);
}

RegistrationResult Register(const SurfelMap& map, const TimedPatches& sweep, const StateBelief& from,
                            const RelativeMotion& hint, const MotionSegment& guess,
                            const RegistrationOptions& options) {
  return Registrar(map, sweep, from, hint, guess, options).Run();
}

}  // namespace lcmslam::octo3d
