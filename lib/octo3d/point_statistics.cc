#include "octo3d/point_statistics.h"

#include <Eigen/Eigenvalues>

namespace lcmslam::octo3d {

void PointStatistics::Merge(const PointStatistics& other, const Eigen::Vector3d& o) {
  // sum (p + o)(p + o)^T = sum p p^T + s o^T + o s^T + n o o^T
  const Eigen::Vector3d& s = other.sum;
  const double n = other.count;
  xx += other.xx + 2.0 * s.x() * o.x() + n * o.x() * o.x();
  yy += other.yy + 2.0 * s.y() * o.y() + n * o.y() * o.y();
  zz += other.zz + 2.0 * s.z() * o.z() + n * o.z() * o.z();
  xy += other.xy + s.x() * o.y() + s.y() * o.x() + n * o.x() * o.y();
  xz += other.xz + s.x() * o.z() + s.z() * o.x() + n * o.x() * o.z();
  yz += other.yz + s.y() * o.z() + s.z() * o.y() + n * o.y() * o.z();
  sum += s + n * o;
  count += n;
}

Eigen::Matrix3d PointStatistics::Covariance() const {
  Eigen::Matrix3d moments;
  moments << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::Vector3d mean = Mean();
  return moments / count - mean * mean.transpose();
}

PlaneFit FitPlane(const PointStatistics& statistics) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(statistics.Covariance());
  return {statistics.Mean(), solver.eigenvectors().col(0), solver.eigenvalues().cwiseMax(0.0)};
}

// All eigenvalues of C exceed v where C - v I is positive definite: Sylvester's criterion.
bool IsThicker(const Eigen::Matrix3d& covariance, double max_variance) {
  const Eigen::Matrix3d rest = covariance - max_variance * Eigen::Matrix3d::Identity();
  return rest(0, 0) > 0.0 && rest(0, 0) * rest(1, 1) > rest(0, 1) * rest(0, 1) && rest.determinant() > 0.0;
}

}  // namespace lcmslam::octo3d
