#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lidar/sweep.h"
#include "octo3d/options.h"

namespace lcmslam::octo3d {

// A small planar piece of one sweep: to a plane, its mean is worth all of its points.
struct Patch {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        // m, lidar frame at the patch's own time
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();  // m^2, of its points
  float count = 0.0F;                                    // points
  uint16_t slot = 0;                                     // of the sweep's TimeSlots
};

// Whether a point is finite and within the range limits.
inline bool InRange(const SweepPoint& p, const PatchOptions& options) {
  const double range2 =
      static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y + static_cast<double>(p.z) * p.z;
  return range2 >= options.min_range_m * options.min_range_m && range2 <= options.max_range_m * options.max_range_m;
}

// Condenses a sweep by an octree over its points (one per time slice): planar cells give their mean, others are split
// down to the finest. Points out of the range limits, non-finite ones and those beyond the first 2^20 are skipped.
// Order and result depend on the input only.
std::vector<Patch> MakePatches(const Sweep& sweep, const PatchOptions& options, double range_noise_m);

}  // namespace lcmslam::octo3d
