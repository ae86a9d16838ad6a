#pragma once

#include <Eigen/Core>

namespace lcmslam::octo3d {

// Count, sum and second moments of points about a fixed reference point (a cell's centre keeps the numbers small).
// Additive: statistics of disjoint sets merge exactly, whatever the number of points. Metres.
struct PointStatistics {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;  // sums of products

  // p: relative to the reference.
  void Add(const Eigen::Vector3d& p);
  // Takes in the points of `other`, whose reference lies at `offset` from this one.
  void Merge(const PointStatistics& other, const Eigen::Vector3d& offset);

  Eigen::Vector3d Mean() const { return sum / count; }  // relative to the reference; needs count > 0
  Eigen::Matrix3d Covariance() const;                   // biased (divides by count); needs count > 0

  bool operator==(const PointStatistics&) const = default;
};

// The total least squares plane: through the mean, normal along the least spread.
struct PlaneFit {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();       // relative to the statistics' reference
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();    // sign arbitrary
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  // m^2, ascending, >= 0: across, then along the plane
};

// Needs count > 0. O(1).
PlaneFit FitPlane(const PointStatistics& statistics);

// Whether the least of FitPlane()'s variances, of points with this covariance, exceeds max_variance: without the fit.
bool IsThicker(const Eigen::Matrix3d& covariance, double max_variance);

inline void PointStatistics::Add(const Eigen::Vector3d& p) {
  count += 1.0;
  sum += p;
  xx += p.x() * p.x();
  xy += p.x() * p.y();
  xz += p.x() * p.z();
  yy += p.y() * p.y();
  yz += p.y() * p.z();
  zz += p.z() * p.z();
}

}  // namespace lcmslam::octo3d
