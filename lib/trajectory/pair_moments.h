#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "trajectory/association.h"

namespace lcmslam {

// What least squares over pairs needs of them, gathered one by one (Welford's update), so that an alignment costs the
// same however many pairs there were. Poses are finite. One thread.
class PairMoments {
 public:
  void Add(const PosePair& pair);

  int64_t count() const { return count_; }
  const Eigen::Vector3d& mean_estimate() const { return mean_estimate_; }
  const Eigen::Vector3d& mean_reference() const { return mean_reference_; }
  // Mean of (p_reference - mean) (p_estimate - mean)^T.
  Eigen::Matrix3d positions() const { return position_products_ / static_cast<double>(count_); }
  // Mean of R_reference R_estimate^T.
  Eigen::Matrix3d orientations() const { return orientation_sum_ / static_cast<double>(count_); }

 private:
  int64_t count_ = 0;
  Eigen::Vector3d mean_estimate_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_reference_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d position_products_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d orientation_sum_ = Eigen::Matrix3d::Zero();
};

}  // namespace lcmslam
