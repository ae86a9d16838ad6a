#include "octo3d/observability.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace lcmslam::octo3d {

Observability FindUnobservable(const Matrix6& information, double min_share) {
  Observability result;
  const double translation = information.topLeftCorner<3, 3>().trace();
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0)) return result;
  const double lever = std::max(std::sqrt(rotation / translation), 1e-3);
  Vector6 scale;
  scale << 1.0, 1.0, 1.0, lever, lever, lever;  // scaled = scale * unscaled coordinates

  const Matrix6 scaled = scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled);
  int held = 0;
  while (held < 6 && solver.eigenvalues()[held] < min_share * translation) ++held;
  if (held == 0) return result;

  const auto directions = solver.eigenvectors().leftCols(held);
  const Matrix6 keep = Matrix6::Identity() - directions * directions.transpose();
  result.projection = scale.asDiagonal() * keep * scale.cwiseInverse().asDiagonal();
  result.held = scale.cwiseInverse().asDiagonal() * directions;
  result.held.colwise().normalize();
  return result;
}

}  // namespace lcmslam::octo3d
