#include "octo3d/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "lidar/pose_table.h"
#include "octo3d/point_statistics.h"
#include "octo3d/thinning.h"

namespace lcmslam::octo3d {

namespace {

constexpr int kAxisBits = 13;  // of the Morton code, per axis
constexpr int kTimeBits = 5;
constexpr int kKeyBits = 3 * kAxisBits + kTimeBits;
constexpr int kRadixBits = 11;
static_assert(kKeyBits == 4 * kRadixBits);

// A point's time slice, Morton code of the finest cell, and index in the sweep, from the highest bits to the lowest.
using KeyedPoint = uint64_t;
constexpr int kIndexBits = 64 - kKeyBits;

uint64_t KeyOf(KeyedPoint point) { return point >> kIndexBits; }
size_t IndexOf(KeyedPoint point) { return point & ((uint64_t{1} << kIndexBits) - 1); }

// Spreads the low 16 bits three apart.
uint64_t Spread(uint64_t v) {
  v = (v | v << 16) & 0x001F0000FF0000FFULL;
  v = (v | v << 8) & 0x100F00F00F00F00FULL;
  v = (v | v << 4) & 0x10C30C30C30C30C3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

// By key, least significant digit first: stable, so that equal keys keep the order of the sweep.
void RadixSort(std::vector<KeyedPoint>& points) {
  constexpr int kPasses = kKeyBits / kRadixBits;
  const auto digit = [](KeyedPoint point, int pass) {
    return (point >> (kIndexBits + pass * kRadixBits)) & ((1 << kRadixBits) - 1);
  };
  std::array<std::array<uint32_t, 1 << kRadixBits>, kPasses> starts = {};
  for (const KeyedPoint point : points) {
    for (int pass = 0; pass < kPasses; ++pass) ++starts[pass][digit(point, pass)];
  }
  std::vector<KeyedPoint> other(points.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    uint32_t sum = 0;
    for (uint32_t& start : starts[pass]) sum += std::exchange(start, sum);
    for (const KeyedPoint point : points) other[starts[pass][digit(point, pass)]++] = point;
    points.swap(other);
  }
}

class PatchMaker {
 public:
  PatchMaker(const Sweep& sweep, const PatchOptions& options, double range_noise_m)
      : sweep_(sweep),
        options_(options),
        max_variance_(kMaxThickness * kMaxThickness * range_noise_m * range_noise_m),
        slots_(FirstPointTime(sweep)) {}

  std::vector<Patch> Make() {
    std::vector<KeyedPoint> points = KeyPoints();
    RadixSort(points);
    Split(points, options_.levels);  // one level above the coarsest: only divides
    return std::move(patches_);
  }

 private:
  std::vector<KeyedPoint> KeyPoints() const {
    const double finest_m = options_.cell_m / (1 << (options_.levels - 1));
    const auto per_cell = static_cast<float>(1.0 / finest_m);
    constexpr float kLimit = 1 << (kAxisBits - 1);
    const auto inside = [](float v) { return v >= 0.0F && v < 2.0F * kLimit; };
    const size_t size = std::min(sweep_.points.size(), size_t{1} << kIndexBits);
    std::vector<KeyedPoint> points;
    points.reserve(size);
    for (size_t i = 0; i < size; ++i) {
      const SweepPoint& p = sweep_.points[i];
      if (!InRange(p, options_)) continue;
      const float x = p.x * per_cell + kLimit, y = p.y * per_cell + kLimit, z = p.z * per_cell + kLimit;
      if (!inside(x) || !inside(y) || !inside(z)) continue;
      const auto slice = static_cast<uint64_t>(slots_.SlotOf(p.dt_us) * options_.time_slices / TimeSlots::kSlots);
      const uint64_t cell = Spread(static_cast<uint32_t>(x)) | Spread(static_cast<uint32_t>(y)) << 1 |
                            Spread(static_cast<uint32_t>(z)) << 2;
      points.push_back((slice << (3 * kAxisBits) | cell) << kIndexBits | i);
    }
    return points;
  }

  // points: of one cell, `level` halvings above the finest.
  void Visit(std::span<const KeyedPoint> points, int level) {
    if (level > 0 && points.size() < kMinPlanePoints) return Split(points, level);
    const SweepPoint& first = sweep_.points[IndexOf(points.front())];
    const Eigen::Vector3d reference(first.x, first.y, first.z);
    PointStatistics statistics;
    int64_t dt_us = 0;
    for (const KeyedPoint keyed : points) {
      const SweepPoint& p = sweep_.points[IndexOf(keyed)];
      statistics.Add(Eigen::Vector3d(p.x, p.y, p.z) - reference);
      dt_us += p.dt_us;
    }
    // The variance of a sample of n varies by sqrt(2 / n) of itself.
    const double max_variance = max_variance_ * (1.0 + std::sqrt(2.0 / statistics.count));
    const Eigen::Matrix3d covariance = statistics.Covariance();
    if (level > 0 && IsThicker(covariance, max_variance)) return Split(points, level);
    const auto mean_dt_us = static_cast<int32_t>(dt_us / static_cast<int64_t>(points.size()));
    patches_.push_back({reference + statistics.Mean(), covariance.cast<float>(), static_cast<float>(statistics.count),
                        static_cast<uint16_t>(slots_.SlotOf(mean_dt_us))});
  }

  // Visits the cells one level finer.
  void Split(std::span<const KeyedPoint> points, int level) {
    const int shift = 3 * (level - 1);
    while (!points.empty()) {
      const uint64_t cell = KeyOf(points.front()) >> shift;
      const auto end = std::ranges::find_if(points, [&](KeyedPoint p) { return KeyOf(p) >> shift != cell; });
      const auto size = static_cast<size_t>(end - points.begin());
      Visit(points.first(size), level - 1);
      points = points.subspan(size);
    }
  }

  static constexpr size_t kMinPlanePoints = 5;
  static constexpr double kMaxThickness = 1.2;  // of a planar patch, in range_noise_m

  const Sweep& sweep_;
  const PatchOptions& options_;
  const double max_variance_;
  const TimeSlots slots_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Patch> MakePatches(const Sweep& sweep, const PatchOptions& options, double range_noise_m) {
  std::vector<Patch> patches = PatchMaker(sweep, options, range_noise_m).Make();
  Thin(patches, static_cast<size_t>(options.max_patches));
  return patches;
}

}  // namespace lcmslam::octo3d
