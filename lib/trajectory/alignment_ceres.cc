#include "trajectory/alignment_ceres.h"

#include <memory>
#include <vector>

#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace lcmslam {
namespace {

// The transform is sought as a small motion (translation, rotation vector) of the estimates that the guess has already
// brought near, turning about their centre so that the six numbers hardly influence each other.
struct PointDistance {
  Eigen::Vector3d estimate;   // moved by the guess, from the centre
  Eigen::Vector3d reference;  // from the centre

  template <typename T>
  bool operator()(const T* translation, const T* rotation, T* residual) const {
    const Eigen::Matrix<T, 3, 1> p = estimate.cast<T>();
    ceres::AngleAxisRotatePoint(rotation, p.data(), residual);
    for (int i = 0; i < 3; ++i) residual[i] += translation[i] - reference[i];
    return true;
  }
};

void HoldConstant(ceres::Problem& problem, double* block, const std::vector<int>& components) {
  if (!components.empty()) problem.SetManifold(block, new ceres::SubsetManifold(3, components));
}

}  // namespace

CeresAlignment AlignByCeres(std::span<const PosePair> pairs, AlignmentKind kind, const Pose3& T_world_map_guess,
                            const CeresAlignmentOptions& options) {
  CeresAlignment result{.converged = false, .T_world_map = T_world_map_guess};
  const bool is_solvable = kind == AlignmentKind::kYaw || kind == AlignmentKind::kSe2 || kind == AlignmentKind::kSe3;
  if (pairs.empty() || !is_solvable) return result;

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) centre += pair.reference.translation / static_cast<double>(pairs.size());

  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  ceres::Problem problem;
  for (const PosePair& pair : pairs) {
    auto* distance =
        new PointDistance{T_world_map_guess * pair.estimate.translation - centre, pair.reference.translation - centre};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PointDistance, 3, 3, 3>(distance),
                             options.huber_m > 0.0 ? new ceres::HuberLoss(options.huber_m) : nullptr,
                             translation.data(), rotation.data());
  }
  if (kind != AlignmentKind::kSe3) HoldConstant(problem, rotation.data(), {0, 1});
  if (kind == AlignmentKind::kSe2) HoldConstant(problem, translation.data(), {2});

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = 100;
  solver.function_tolerance = 1e-16;
  solver.parameter_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-14;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) return result;

  const double angle = rotation.norm();
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(angle, angle > 0.0 ? Eigen::Vector3d(rotation / angle) : Eigen::Vector3d::UnitX()));
  const Pose3 T_world_guess{centre + translation - turn * centre, turn};
  result.converged = true;
  result.T_world_map = T_world_guess * T_world_map_guess;
  return result;
}

}  // namespace lcmslam
