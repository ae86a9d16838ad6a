#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trajectory/alignment.h"

namespace lcmslam {

struct CalibrationOptions {
  // kSe3: nothing is known of how the two frames stand to each other. kSe2: both have the same up and the same z = 0,
  // so that a planar run tells the marker's height.
  AlignmentKind alignment = AlignmentKind::kSe3;
  int64_t max_gap_us = 300'000;        // as in AssociationOptions
  double max_time_offset_s = 1.0;      // searched on both sides of 0
  double huber_sigmas = 2.5;           // residuals beyond weigh linearly
  double max_time_offset_sd_s = 0.01;  // a parameter known less well than these counts as not excited
  double max_lever_arm_sd_m = 0.02;    // by the motion, and is held at its start:
  double max_rotation_sd_rad = 0.02;   // 0, 0, the mean difference in orientation
  size_t max_pairs = 20'000;           // longer runs are thinned evenly
  std::string Validate() const;        // "" or "field: reason"
};

enum class CalibrationStatus { kOk, kTooFewPairs, kNotConverged };

struct Calibration {
  CalibrationStatus status = CalibrationStatus::kTooFewPairs;
  double time_offset_s = 0.0;     // reference stamp = estimate stamp + offset
  Pose3 T_body_marker;            // the reference's marker in the estimate's body frame: lever arm and rotation
  Pose3 T_world_map;              // alignment that belongs to it
  int64_t pairs = 0;              // that took part
  double position_sigma_m = 0.0;  // of one residual along an axis, robust
  double orientation_sigma_rad = 0.0;

  // Standard deviations for independent residuals; infinite where the motion tells nothing. Errors of SLAM are
  // correlated in time, which makes them optimistic.
  double time_offset_sd_s = 0.0;
  Eigen::Vector3d lever_arm_sd_m = Eigen::Vector3d::Zero();   // body axes
  Eigen::Vector3d rotation_sd_rad = Eigen::Vector3d::Zero();  // about body axes
  std::vector<std::string> unexcited;                         // "time offset", "lever arm x", "rotation about z", ...
};

// Solves jointly for time offset, T_body_marker and T_world_map such that
//   T_world_marker(t + time_offset) = T_world_map T_map_body(t) T_body_marker
// in positions and orientations, by Ceres with a Huber loss. The estimate is that of the body, the reference that of a
// marker fixed to it. Poses are finite, stamps strictly increasing. Deterministic; one thread.
[[nodiscard]] Calibration Calibrate(std::span<const StampedPose> estimate, std::span<const StampedPose> reference,
                                    const CalibrationOptions& options = {});

}  // namespace lcmslam
