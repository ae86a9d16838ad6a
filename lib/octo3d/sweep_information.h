#pragma once

#include <array>

#include <Eigen/Core>

#include "lidar/pose_table.h"
#include "octo3d/motion.h"

namespace lcmslam::octo3d {

// The normal equations of one sweep, kept apart by time so that they can be laid onto the states at its two ends.
// A bin holds sum w J J^T and sum w J r of the patches of its time; J is the 6-vector (translation, rotation) at that
// time.
class SweepInformation {
 public:
  static constexpr int kBins = 32;

  void Clear() { bins_.fill(Bin{}); }
  // slot: of TimeSlots.
  void Add(int slot, const Vector6& J, double residual, double weight);

  // The information about the sweep moved as a rigid whole.
  Matrix6 Total() const;

  // Adds to H and b (states from, to: 12 + 12), after projecting every bin by P: P H P, P b.
  void AddTo(const MotionSegment& motion, const TimeSlots& slots, Eigen::Matrix<double, 24, 24>& H,
             Eigen::Matrix<double, 24, 1>& b) const;

 private:
  struct Bin {
    std::array<double, 21> upper = {};  // row by row
    std::array<double, 6> b = {};
    bool used = false;

    Matrix6 Full() const;
  };
  std::array<Bin, kBins> bins_ = {};
};

}  // namespace lcmslam::octo3d
