#include "octo3d/sweep_information.h"

namespace lcmslam::octo3d {

Matrix6 SweepInformation::Bin::H() const {
  Matrix6 H;
  H.topLeftCorner<3, 3>() = normal_normal.topRows<3>().cast<double>();
  H.topRightCorner<3, 3>() = normal_moment.topRows<3>().cast<double>();
  H.bottomLeftCorner<3, 3>() = H.topRightCorner<3, 3>().transpose();
  H.bottomRightCorner<3, 3>() = moment_moment.topRows<3>().cast<double>();
  return H;
}

Vector6 SweepInformation::Bin::b() const {
  Vector6 b;
  b << normal_residual.head<3>().cast<double>(), moment_residual.head<3>().cast<double>();
  return b;
}

Matrix6 SweepInformation::Total() const {
  Matrix6 H = Matrix6::Zero();
  for (const Bin& bin : bins_) {
    if (bin.used) H += bin.H();
  }
  return H;
}

void SweepInformation::AddTo(const MotionSegment& motion, const TimeSlots& slots, Eigen::Matrix<double, 24, 24>& H,
                             Eigen::Matrix<double, 24, 1>& b) const {
  for (int i = 0; i < kBins; ++i) {
    if (!bins_[i].used) continue;
    const double middle_slot = (i + 0.5) * kSlotsPerBin - 0.5;
    const double dt_us = slots.MiddleUs(middle_slot);
    const Eigen::Vector4d h = motion.Influence(1.0 + 1e-6 * dt_us / motion.duration_s());
    const Matrix6 H_bin = bins_[i].H();
    const Vector6 b_bin = bins_[i].b();
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) H.block<6, 6>(6 * row, 6 * column) += h[row] * h[column] * H_bin;
      b.segment<6>(6 * row) += h[row] * b_bin;
    }
  }
}

}  // namespace lcmslam::octo3d
