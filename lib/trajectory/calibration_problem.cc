#include "trajectory/calibration_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <Eigen/SparseCore>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include "trajectory/summary.h"

namespace lcmslam {
namespace {

// The median length of a Gaussian vector of three independent components, in units of their sigma.
constexpr double kMedianOfMaxwell = 1.5382;
constexpr double kLeastSigma = 1e-6;  // m, rad: keeps perfect data solvable

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <typename T>
Vector3<T> Rotate(const T* rotation_vector, const Vector3<T>& p) {
  Vector3<T> rotated;
  ceres::AngleAxisRotatePoint(rotation_vector, p.data(), rotated.data());
  return rotated;
}

template <typename T>
Eigen::Quaternion<T> ToQuaternion(const T* rotation_vector) {
  T wxyz[4];
  ceres::AngleAxisToQuaternion(rotation_vector, wxyz);
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

// Coefficients times (1, s, s^2), s being the time from the moment of the fit.
template <typename T, int kRows>
Eigen::Matrix<T, kRows, 1> Evaluate(const Eigen::Matrix<double, kRows, 3>& coefficients, const T& s) {
  return coefficients.template cast<T>() * Vector3<T>(T(1.0), s, s * s);
}

struct Context {
  CalibrationSample sample;
  double fitted_offset_s;
  double sigma;
};

struct MarkerPosition : Context {
  Pose3 T_centre_body;  // T_map_body moved by the start and seen from the centre
  Eigen::Vector3d centre;

  template <typename T>
  bool operator()(const T* time_offset, const T* lever_arm, const T* world_translation, const T* world_rotation,
                  T* residual) const {
    const T s = (*time_offset - fitted_offset_s) / sample.reference.half_width_s;
    const Vector3<T> arm = Eigen::Map<const Vector3<T>>(lever_arm);
    const Vector3<T> at_start = T_centre_body.rotation.cast<T>() * arm + T_centre_body.translation.cast<T>();
    const Vector3<T> p_marker = Rotate(world_rotation, at_start) + Eigen::Map<const Vector3<T>>(world_translation);
    const Vector3<T> p_reference = Evaluate<T, 3>(sample.reference.position, s) - centre.cast<T>();
    Eigen::Map<Vector3<T>>{residual} = (p_marker - p_reference) / T(sigma);
    return true;
  }
};

struct MarkerOrientation : Context {
  Eigen::Quaterniond world_start;   // of T_world_map
  Eigen::Quaterniond marker_start;  // of T_body_marker

  template <typename T>
  bool operator()(const T* time_offset, const T* marker_rotation, const T* world_rotation, T* residual) const {
    const T s = (*time_offset - fitted_offset_s) / sample.reference.half_width_s;
    const Eigen::Quaternion<T> marker = ToQuaternion(world_rotation) *
                                        (world_start * sample.T_map_body.rotation).cast<T>() *
                                        ToQuaternion(marker_rotation) * marker_start.cast<T>();
    const Eigen::Matrix<T, 4, 1> q = Evaluate<T, 4>(sample.reference.quaternion, s);
    const Eigen::Quaternion<T> difference = Eigen::Quaternion<T>(q).normalized().conjugate() * marker;
    const T wxyz[4] = {difference.w(), difference.x(), difference.y(), difference.z()};
    ceres::QuaternionToAngleAxis(wxyz, residual);
    Eigen::Map<Vector3<T>>{residual} /= T(sigma);
    return true;
  }
};

void HoldComponents(ceres::Problem& problem, double* block, const std::vector<int>& components) {
  if (components.size() == 3) {
    problem.SetParameterBlockConstant(block);
  } else if (!components.empty()) {
    problem.SetManifold(block, new ceres::SubsetManifold(3, components));
  }
}

bool SolveByCeres(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();  // along directions that nothing determines it may creep on
}

// J^T J of the whole problem, columns in the order of `blocks` without what is held.
Eigen::MatrixXd Information(ceres::Problem& problem, const std::vector<double*>& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks;
  ceres::CRSMatrix jacobian;
  problem.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> j(
      jacobian.num_rows, jacobian.num_cols, static_cast<Eigen::Index>(jacobian.values.size()), jacobian.rows.data(),
      jacobian.cols.data(), jacobian.values.data());
  return Eigen::MatrixXd(Eigen::SparseMatrix<double>(j.transpose() * j));
}

// The noise along one axis, from residual vectors that were whitened with `sigma`.
double RobustSigma(ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& blocks, double sigma) {
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = blocks;
  options.apply_loss_function = false;
  std::vector<double> residuals, lengths;
  problem.Evaluate(options, nullptr, &residuals, nullptr, nullptr);
  for (size_t i = 0; i < residuals.size(); i += 3) {
    lengths.push_back(sigma * std::hypot(residuals[i], residuals[i + 1], residuals[i + 2]));
  }
  return std::max(Percentile(lengths, 0.5) / kMedianOfMaxwell, kLeastSigma);
}

}  // namespace

CalibrationProblem::CalibrationProblem(std::span<const PosePair> pairs, const Pose3& T_world_map_start,
                                       const CalibrationOptions& options)
    : huber_sigmas_(options.huber_sigmas), start_{.T_world_map = T_world_map_start} {
  Eigen::Matrix3d sum_of_differences = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs) {
    start_.centre += pair.reference.translation / static_cast<double>(pairs.size());
    const Eigen::Quaterniond world_body = T_world_map_start.rotation * pair.estimate.rotation;
    sum_of_differences += (world_body.conjugate() * pair.reference.rotation).toRotationMatrix();
  }
  start_.marker = Eigen::Quaterniond(NearestRotation(sum_of_differences));
  if (options.alignment == AlignmentKind::kSe2) {
    held_.world_translation = {2};
    held_.world_rotation = {0, 1};
  }
}

void CalibrationProblem::HoldAtStart(std::span<const int> parameters) {
  for (const int k : parameters) {
    if (k == 0) {
      held_.time_offset = true;
      unknowns_.time_offset_s = 0.0;
    } else if (k <= 3) {
      held_.lever_arm.push_back(k - 1);
      unknowns_.lever_arm[k - 1] = 0.0;
    } else {
      held_.marker_rotation.push_back(k - 4);
      unknowns_.marker_rotation[k - 4] = 0.0;
    }
  }
}

struct CalibrationProblem::Residuals {
  std::unique_ptr<ceres::Problem> problem = std::make_unique<ceres::Problem>();
  std::vector<ceres::ResidualBlockId> position, orientation;
};

CalibrationProblem::Residuals CalibrationProblem::AddResiduals(std::span<const CalibrationSample> samples,
                                                               double fitted_offset_s) {
  Unknowns& u = unknowns_;
  Residuals residuals;
  for (const CalibrationSample& sample : samples) {
    Pose3 T_centre_body = start_.T_world_map * sample.T_map_body;
    T_centre_body.translation -= start_.centre;
    auto* position = new MarkerPosition{{sample, fitted_offset_s, position_sigma_m_}, T_centre_body, start_.centre};
    residuals.position.push_back(residuals.problem->AddResidualBlock(
        new ceres::AutoDiffCostFunction<MarkerPosition, 3, 1, 3, 3, 3>(position), new ceres::HuberLoss(huber_sigmas_),
        &u.time_offset_s, u.lever_arm.data(), u.world_translation.data(), u.world_rotation.data()));
    auto* orientation = new MarkerOrientation{
        {sample, fitted_offset_s, orientation_sigma_rad_}, start_.T_world_map.rotation, start_.marker};
    residuals.orientation.push_back(residuals.problem->AddResidualBlock(
        new ceres::AutoDiffCostFunction<MarkerOrientation, 3, 1, 3, 3>(orientation),
        new ceres::HuberLoss(huber_sigmas_), &u.time_offset_s, u.marker_rotation.data(), u.world_rotation.data()));
  }
  if (held_.time_offset) residuals.problem->SetParameterBlockConstant(&u.time_offset_s);
  HoldComponents(*residuals.problem, u.lever_arm.data(), held_.lever_arm);
  HoldComponents(*residuals.problem, u.marker_rotation.data(), held_.marker_rotation);
  HoldComponents(*residuals.problem, u.world_translation.data(), held_.world_translation);
  HoldComponents(*residuals.problem, u.world_rotation.data(), held_.world_rotation);
  return residuals;
}

bool CalibrationProblem::Solve(std::span<const CalibrationSample> samples, double fitted_offset_s) {
  constexpr size_t kFewest = 10;
  samples_ = static_cast<int64_t>(samples.size());
  if (samples.size() < kFewest) return false;
  const Residuals residuals = AddResiduals(samples, fitted_offset_s);
  if (!SolveByCeres(*residuals.problem)) return false;

  Unknowns& u = unknowns_;
  last_time_step_s_ = std::abs(u.time_offset_s - fitted_offset_s);
  information_ = Information(*residuals.problem, {&u.time_offset_s, u.lever_arm.data(), u.marker_rotation.data(),
                                                  u.world_translation.data(), u.world_rotation.data()});
  position_sigma_m_ = RobustSigma(*residuals.problem, residuals.position, position_sigma_m_);
  orientation_sigma_rad_ = RobustSigma(*residuals.problem, residuals.orientation, orientation_sigma_rad_);
  return true;
}

CalibrationProblem::Deviations CalibrationProblem::StandardDeviations() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNullEigenvalue = 1e-10, kNullShare = 1e-3;
  const Eigen::VectorXd scale = information_.diagonal().cwiseMax(1e-60).cwiseSqrt();
  const Eigen::MatrixXd normalized =
      scale.cwiseInverse().asDiagonal() * information_ * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normalized);
  Deviations variance = Deviations::Zero();
  for (Eigen::Index j = 0; j < eigen.eigenvalues().size(); ++j) {
    const bool is_null = eigen.eigenvalues()[j] < kNullEigenvalue;
    for (int k = 0; k < kCalibrated; ++k) {
      const double share = eigen.eigenvectors()(k, j);
      if (is_null && std::abs(share) > kNullShare) variance[k] = kInfinity;
      if (!is_null) variance[k] += share * share / eigen.eigenvalues()[j];
    }
  }
  Deviations sd = variance.cwiseSqrt().cwiseQuotient(scale.head<kCalibrated>());
  sd[0] = std::max(sd[0], last_time_step_s_);  // an offset that has not settled is not known better than that
  return sd;
}

Pose3 CalibrationProblem::T_body_marker() const {
  return {unknowns_.lever_arm, (ToQuaternion(unknowns_.marker_rotation.data()) * start_.marker).normalized()};
}

Pose3 CalibrationProblem::T_world_map() const {
  const Eigen::Quaterniond turn = ToQuaternion(unknowns_.world_rotation.data());
  return Pose3{start_.centre + unknowns_.world_translation - turn * start_.centre, turn} * start_.T_world_map;
}

}  // namespace lcmslam
