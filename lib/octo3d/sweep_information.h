#pragma once

#include <array>

#include <Eigen/Core>

#include "lidar/pose_table.h"
#include "octo3d/motion.h"

namespace lcmslam::octo3d {

// The normal equations of one sweep, kept apart by time so that they can be laid onto the states at its two ends.
// A bin holds sum w J J^T and sum w J r of the patches of its time; J is the 6-vector (translation, rotation) at that
// time: (normal, moment). Products in single precision, sums in double.
class SweepInformation {
 public:
  static constexpr int kBins = 32;

  void Clear() { bins_.fill(Bin{}); }
  // slot: of TimeSlots. The fourth components do not count.
  void Add(int slot, const Eigen::Vector4f& normal, const Eigen::Vector4f& moment, float residual, float weight) {
    bins_[slot / kSlotsPerBin].Add(normal, moment, residual, weight);
  }

  // The information about the sweep moved as a rigid whole.
  Matrix6 Total() const;

  // Adds to H and b (states from, to: 12 + 12).
  void AddTo(const MotionSegment& motion, const TimeSlots& slots, Eigen::Matrix<double, 24, 24>& H,
             Eigen::Matrix<double, 24, 1>& b) const;

 private:
  static constexpr int kSlotsPerBin = TimeSlots::kSlots / kBins;

  // Padded, so that a column is a register.
  struct Bin {
    Eigen::Matrix<float, 4, 3> normal_normal = Eigen::Matrix<float, 4, 3>::Zero();
    Eigen::Matrix<float, 4, 3> normal_moment = Eigen::Matrix<float, 4, 3>::Zero();
    Eigen::Matrix<float, 4, 3> moment_moment = Eigen::Matrix<float, 4, 3>::Zero();
    Eigen::Vector4f normal_residual = Eigen::Vector4f::Zero();
    Eigen::Vector4f moment_residual = Eigen::Vector4f::Zero();
    bool used = false;

    void Add(const Eigen::Vector4f& normal, const Eigen::Vector4f& moment, float residual, float weight);
    Matrix6 H() const;
    Vector6 b() const;
  };
  std::array<Bin, kBins> bins_ = {};
};

inline void SweepInformation::Bin::Add(const Eigen::Vector4f& normal, const Eigen::Vector4f& moment, float residual,
                                       float weight) {
  used = true;
  const Eigen::Vector4f w_normal = weight * normal, w_moment = weight * moment;
  for (int k = 0; k < 3; ++k) {
    normal_normal.col(k) += w_normal[k] * normal;
    normal_moment.col(k) += w_moment[k] * normal;
    moment_moment.col(k) += w_moment[k] * moment;
  }
  normal_residual += residual * w_normal;
  moment_residual += residual * w_moment;
}

}  // namespace lcmslam::octo3d
