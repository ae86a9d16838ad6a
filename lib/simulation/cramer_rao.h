#pragma once

#include <optional>

#include <Eigen/Eigenvalues>

namespace lcmslam {

// The Cramer-Rao bound, inv(information): no unbiased estimate has a smaller covariance. None where the information
// does not fix all N coordinates (smallest over largest eigenvalue below 1e-9).
template <int N>
std::optional<Eigen::Matrix<double, N, N>> CramerRaoBound(const Eigen::Matrix<double, N, N>& information) {
  constexpr double kWorstConditioning = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(information);
  const auto& eigenvalues = solver.eigenvalues();  // ascending
  if (!(eigenvalues[0] > kWorstConditioning * eigenvalues[N - 1])) return std::nullopt;
  return solver.eigenvectors() * eigenvalues.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace lcmslam
