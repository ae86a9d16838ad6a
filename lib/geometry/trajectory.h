#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/pose3.h"

namespace lcmslam {

struct StampedPose {
  int64_t utime = 0;  // us
  Pose3 pose;         // T_map_body unless said otherwise
};

// Stamps strictly increasing.
using Trajectory = std::vector<StampedPose>;

// The pose at `utime`: linear + SLERP between the two neighbours. None outside the trajectory, or where the
// neighbours are more than max_gap_us apart. O(log n).
std::optional<Pose3> InterpolateAt(std::span<const StampedPose> trajectory, int64_t utime,
                                   int64_t max_gap_us = INT64_MAX);

}  // namespace lcmslam
