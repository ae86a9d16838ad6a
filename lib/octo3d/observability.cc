#include "octo3d/observability.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace lcmslam::octo3d {

Directions UnobservableDirections(const Matrix6& information, double min_share, const Matrix6& noise) {
  const double translation = information.topLeftCorner<3, 3>().trace();
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0)) return Directions(6, 0);
  const double lever = std::max(std::sqrt(rotation / translation), 1e-3);
  Vector6 scale;
  scale << 1.0, 1.0, 1.0, lever, lever, lever;  // scaled = scale * unscaled coordinates

  const Matrix6 scaled = scale.cwiseInverse().asDiagonal() * (information - noise) * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled);
  int count = 0;
  while (count < 6 && solver.eigenvalues()[count] < min_share * translation) ++count;
  Directions unobservable = scale.cwiseInverse().asDiagonal() * solver.eigenvectors().leftCols(count);
  unobservable.colwise().normalize();
  return unobservable;
}

}  // namespace lcmslam::octo3d
