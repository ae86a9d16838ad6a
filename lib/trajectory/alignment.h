#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/association.h"
#include "trajectory/pair_moments.h"

namespace lcmslam {

enum class AlignmentKind {
  kNone,   // the frames are taken to be the same
  kFirst,  // the first pair's poses are made equal
  kYaw,    // least squares over x, y, z, yaw
  kSe2,    // least squares over x, y, yaw of poses in the plane
  kSe3,    // least squares over x, y, z and rotation
};
[[nodiscard]] std::string_view Name(AlignmentKind kind);  // none, first, yaw, se2, se3
[[nodiscard]] std::optional<AlignmentKind> ParseAlignmentKind(std::string_view name);

struct AlignmentOptions {
  double min_spread_m = 0.01;    // positions that spread less, root mean square, do not tell directions apart
  std::string Validate() const;  // "" or "field: reason"
};

enum class AlignmentStatus { kOk, kNoPairs };

struct Alignment {
  AlignmentStatus status = AlignmentStatus::kNoPairs;
  AlignmentKind kind = AlignmentKind::kNone;
  Pose3 T_world_map;  // from the estimate's frame into the reference's; identity unless kOk
  // Axes of rotation (unit, world frame) that the positions do not determine: none, the direction of a straight run, or
  // all that `kind` solves for when standing still. The mean difference in orientation was used about these.
  std::vector<Eigen::Vector3d> unobservable_axes = {};
};

// The rigid transform, without scale, that minimizes sum |p_reference - T_world_map p_estimate|^2 in closed form
// (Umeyama 1991; in yaw, Horn's planar case). Poses are finite. Pure.
[[nodiscard]] Alignment Align(std::span<const PosePair> pairs, AlignmentKind kind,
                              const AlignmentOptions& options = {});
// The same from the moments of all pairs, one or more, and the first of them.
[[nodiscard]] Alignment Align(const PairMoments& moments, const PosePair& first, AlignmentKind kind,
                              const AlignmentOptions& options = {});

// The rotation R that maximizes trace(R^T correlation) (Kabsch 1976; Umeyama 1991, eq. 40-43): of a sum of rotations
// their mean. Finite.
[[nodiscard]] Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& correlation);

// Moves the estimates into the world frame: T_world_body = T_world_map * T_map_body.
void Apply(const Pose3& T_world_map, std::span<PosePair> pairs);

// "" or "standing still: rotation is not observable from positions" and the like.
[[nodiscard]] std::string DescribeUnobservable(const Alignment& alignment);

}  // namespace lcmslam
