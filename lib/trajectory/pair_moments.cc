#include "trajectory/pair_moments.h"

#include <Eigen/Geometry>

namespace lcmslam {

void PairMoments::Add(const PosePair& pair) {
  ++count_;
  const double share = 1.0 / static_cast<double>(count_);
  const Eigen::Vector3d from_old_mean = pair.reference.translation - mean_reference_;
  mean_reference_ += share * from_old_mean;
  mean_estimate_ += share * (pair.estimate.translation - mean_estimate_);
  position_products_ += from_old_mean * (pair.estimate.translation - mean_estimate_).transpose();
  orientation_sum_ += (pair.reference.rotation * pair.estimate.rotation.conjugate()).toRotationMatrix();
}

}  // namespace lcmslam
