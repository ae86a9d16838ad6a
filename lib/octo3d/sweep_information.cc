#include "octo3d/sweep_information.h"

namespace lcmslam::octo3d {

namespace {
constexpr int kSlotsPerBin = TimeSlots::kSlots / SweepInformation::kBins;
}

void SweepInformation::Add(int slot, const Vector6& J, double residual, double weight) {
  Bin& bin = bins_[slot / kSlotsPerBin];
  bin.used = true;
  int k = 0;
  for (int i = 0; i < 6; ++i) {
    const double wJ = weight * J[i];
    for (int j = i; j < 6; ++j) bin.upper[k++] += wJ * J[j];
    bin.b[i] += wJ * residual;
  }
}

Matrix6 SweepInformation::Bin::Full() const {
  Matrix6 H;
  int k = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) H(i, j) = H(j, i) = upper[k++];
  }
  return H;
}

Matrix6 SweepInformation::Total() const {
  Matrix6 H = Matrix6::Zero();
  for (const Bin& bin : bins_) {
    if (bin.used) H += bin.Full();
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
    const Matrix6 H_bin = bins_[i].Full();
    const Eigen::Map<const Vector6> b_bin(bins_[i].b.data());
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) H.block<6, 6>(6 * row, 6 * column) += h[row] * h[column] * H_bin;
      b.segment<6>(6 * row) += h[row] * b_bin;
    }
  }
}

}  // namespace lcmslam::octo3d
