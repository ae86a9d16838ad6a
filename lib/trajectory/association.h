#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/trajectory.h"

namespace lcmslam {

// The estimate and the reference at one moment, that of the estimate.
struct PosePair {
  int64_t utime = 0;  // us, the estimate's stamp
  Pose3 estimate;     // T_map_body; T_world_body's guess once aligned
  Pose3 reference;    // T_world_body
};

struct AssociationOptions {
  int64_t max_gap_us = 300'000;  // the reference is interpolated between stamps at most this far apart
  int64_t time_offset_us = 0;    // added to the estimate's stamps to get the reference's
  std::string Validate() const;  // "" or "field: reason"
};

struct Association {
  std::vector<PosePair> pairs;  // stamps strictly increasing
  int64_t before = 0;           // poses of the estimate that have no partner: before the reference began,
  int64_t after = 0;            // after it ended,
  int64_t in_gap = 0;           // in a gap of it

  int64_t unmatched() const { return before + after + in_gap; }
  double coverage() const;  // matched / all poses of the estimate; 0 for none
};

// Interpolates the reference at each stamp of the estimate, linear + SLERP, never extrapolating. Poses are finite,
// stamps strictly increasing in both and within +-2^62 us. O(n + m).
[[nodiscard]] Association Associate(std::span<const StampedPose> estimate, std::span<const StampedPose> reference,
                                    const AssociationOptions& options = {});

// Keeps x, y and yaw of both sides; z, roll and pitch become 0.
void FlattenToPlane(std::span<PosePair> pairs);

// Whether z, roll and pitch are the same (to 1e-6 m and rad) in all poses and those of a level body.
[[nodiscard]] bool IsPlanar(std::span<const StampedPose> trajectory);

}  // namespace lcmslam
