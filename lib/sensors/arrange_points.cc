#include "sensors/arrange_points.h"

#include <algorithm>
#include <cmath>

namespace lcmslam {
namespace {

constexpr std::ptrdiff_t kNeighbours = 2;

}  // namespace

void DropNoReturns(std::vector<SweepPoint>& points) {
  std::erase_if(points,
                [](const SweepPoint& p) { return !p.IsFinite() || (p.x == 0.0F && p.y == 0.0F && p.z == 0.0F); });
}

void SetRingsByElevation(const MultiLineModel& model, std::span<SweepPoint> points) {
  std::vector<Laser> lasers = model.lasers;
  std::ranges::sort(lasers, {}, &Laser::elevation_rad);
  const double span_rad = lasers.back().elevation_rad - lasers.front().elevation_rad;
  const double tolerance_rad = 0.5 * span_rad / std::max(1.0, static_cast<double>(lasers.size()) - 1.0);
  for (SweepPoint& p : points) {
    if (p.ring >= 0 || !p.IsFinite()) continue;
    const double across_m = std::hypot(p.x, p.y);
    const auto above = std::ranges::lower_bound(lasers, std::atan2(p.z, across_m), {}, &Laser::elevation_rad);
    // The beams leave the axis at different heights, which close by counts for more than their spacing.
    const auto first = above - std::min<std::ptrdiff_t>(kNeighbours, above - lasers.begin());
    const auto end = above + std::min<std::ptrdiff_t>(kNeighbours, lasers.end() - above);
    const auto error_rad = [&](const Laser& laser) {
      return std::abs(std::atan2(p.z - laser.height_m, across_m) - laser.elevation_rad);
    };
    const auto nearest = std::ranges::min_element(first, end, {}, error_rad);
    if (error_rad(*nearest) <= tolerance_rad) p.ring = nearest->ring;
  }
}

void SortByTime(std::span<SweepPoint> points) {
  if (!std::ranges::is_sorted(points, {}, &SweepPoint::dt_us)) {
    std::ranges::stable_sort(points, {}, &SweepPoint::dt_us);
  }
}

}  // namespace lcmslam
