#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geometry/trajectory.h"
#include "trajectory/pose_errors.h"

namespace lcmslam {

// A trusted relative pose between two moments of a log (Kuemmerle et al. 2009, "On measuring the accuracy of SLAM
// algorithms"), for logs that have no ground truth but where a person has matched scans.
struct Relation {
  int64_t utime1 = 0;  // us
  int64_t utime2 = 0;  // us
  Pose3 T_1_2;         // the body at utime2 in the frame of the body at utime1
};

struct RelationFile {
  std::vector<Relation> relations;  // empty on error
  std::string error;                // "" or "FILE:LINE: reason"
};

// Lines `t1 t2 x y z roll pitch yaw` (s, m, rad; R = Rz(yaw) Ry(pitch) Rx(roll)); # starts a comment line.
[[nodiscard]] RelationFile ReadRelations(const std::filesystem::path& path);

struct RelationErrors {
  PoseErrors errors;      // of T_1_2, one entry a matched relation
  int64_t unmatched = 0;  // relations with a stamp at which the estimate has no pose
};

// The error of (T_map_1)^-1 T_map_2 for each relation; the estimate is interpolated (InterpolateAt) across at most
// max_gap_us. O(m log n).
[[nodiscard]] RelationErrors EvaluateRelations(std::span<const StampedPose> estimate,
                                               std::span<const Relation> relations, int64_t max_gap_us);

}  // namespace lcmslam
