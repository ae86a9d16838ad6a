#include "geometry/trajectory.h"

#include <algorithm>

#include "geometry/utime.h"

namespace lcmslam {

std::optional<Pose3> InterpolateAt(std::span<const StampedPose> trajectory, int64_t utime, int64_t max_gap_us) {
  const auto after = std::ranges::lower_bound(trajectory, utime, {}, &StampedPose::utime);
  if (after == trajectory.end()) return std::nullopt;
  if (after->utime == utime) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *std::prev(after);
  const int64_t gap_us = UtimeDifference(after->utime, before.utime);
  if (gap_us > max_gap_us) return std::nullopt;
  const auto since_us = static_cast<double>(UtimeDifference(utime, before.utime));
  return Interpolate(before.pose, after->pose, since_us / static_cast<double>(gap_us));
}

}  // namespace lcmslam
