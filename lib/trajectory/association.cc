#include "trajectory/association.h"

#include <algorithm>
#include <cmath>

namespace lcmslam {

std::string AssociationOptions::Validate() const { return max_gap_us > 0 ? "" : "max_gap_us: must be positive"; }

double Association::coverage() const {
  const auto matched = static_cast<double>(pairs.size());
  return pairs.empty() ? 0.0 : matched / (matched + static_cast<double>(unmatched()));
}

Association Associate(std::span<const StampedPose> estimate, std::span<const StampedPose> reference,
                      const AssociationOptions& options) {
  Association result;
  result.pairs.reserve(estimate.size());
  auto after = reference.begin();  // the first reference pose that is not before the estimate's
  for (const StampedPose& e : estimate) {
    const int64_t utime = e.utime + options.time_offset_us;
    after = std::find_if(after, reference.end(), [utime](const StampedPose& r) { return r.utime >= utime; });
    if (after == reference.end()) {
      ++result.after;
    } else if (after->utime == utime) {
      result.pairs.push_back({e.utime, e.pose, after->pose});
    } else if (after == reference.begin()) {
      ++result.before;
    } else if (const auto pose = InterpolateAt({std::prev(after), std::next(after)}, utime, options.max_gap_us)) {
      result.pairs.push_back({e.utime, e.pose, *pose});
    } else {
      ++result.in_gap;
    }
  }
  return result;
}

void FlattenToPlane(std::span<PosePair> pairs) {
  for (PosePair& pair : pairs) {
    pair.estimate = ToPose3(ToPose2(pair.estimate));
    pair.reference = ToPose3(ToPose2(pair.reference));
  }
}

bool IsPlanar(std::span<const StampedPose> trajectory) {
  constexpr double kTolerance = 1e-6;
  return std::ranges::all_of(trajectory, [&](const StampedPose& p) {
    const double tilt = 2.0 * std::hypot(p.pose.rotation.x(), p.pose.rotation.y());
    return std::abs(p.pose.translation.z() - trajectory.front().pose.translation.z()) < kTolerance && tilt < kTolerance;
  });
}

}  // namespace lcmslam
