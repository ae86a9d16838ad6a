#include "geometry/trajectory.h"

#include <algorithm>

namespace lcmslam {

std::optional<Pose3> InterpolateAt(std::span<const StampedPose> trajectory, int64_t utime, int64_t max_gap_us) {
  const auto after = std::ranges::lower_bound(trajectory, utime, {}, &StampedPose::utime);
  if (after == trajectory.end()) return std::nullopt;
  if (after->utime == utime) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *std::prev(after);
  const int64_t gap_us = after->utime - before.utime;
  if (gap_us > max_gap_us) return std::nullopt;
  return Interpolate(before.pose, after->pose, static_cast<double>(utime - before.utime) / static_cast<double>(gap_us));
}

}  // namespace lcmslam
