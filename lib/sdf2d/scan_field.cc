#include "sdf2d/scan_field.h"

#include <algorithm>
#include <cmath>

#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

// Intersects [low, high] with {x : min <= slope x + intercept <= max}.
void ClipInterval(double slope, double intercept, double min, double max, double* low, double* high) {
  if (std::abs(slope) < 1e-12) {
    if (intercept < min || intercept > max) *high = *low - 1.0;
    return;
  }
  const double a = (min - intercept) / slope;
  const double b = (max - intercept) / slope;
  *low = std::max(*low, std::min(a, b));
  *high = std::min(*high, std::max(a, b));
}

}  // namespace

void ScanField::Rasterize(std::span<const SurfaceLine> lines, const Pose2& T_map_body, double cell_m,
                          const FusionOptions& options) {
  measurements_.clear();
  if (++stamp_ == 0) {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    stamp_ = 1;
  }
  for (const SurfaceLine& line : lines) AddLine(line, T_map_body, cell_m, options);
}

void ScanField::AddLine(const SurfaceLine& line, const Pose2& T_map_body, double cell_m, const FusionOptions& options) {
  const Vector2d normal = T_map_body.rotation() * line.normal;
  const Vector2d begin = T_map_body * line.begin;
  const Vector2d end = T_map_body * line.end;
  const double length = (end - begin).norm();
  const Vector2d along = length > 1e-9 ? Vector2d((end - begin) / length) : Vector2d(-normal.y(), normal.x());
  const double band_m =
      std::max(options.band_cells * cell_m, std::min(options.band_sigmas * line.beam_sigma_m, options.max_band_m));
  const double reach_m = options.end_cells * cell_m;

  const int sheet = SdfTile::SheetOf(normal);

  // The rows of vertices that cross the rectangle around the piece, and in each the columns.
  const double half_height = std::abs(normal.y()) * band_m + std::abs(along.y()) * reach_m;
  const auto row_low = static_cast<int32_t>(std::ceil((std::min(begin.y(), end.y()) - half_height) / cell_m));
  const auto row_high = static_cast<int32_t>(std::floor((std::max(begin.y(), end.y()) + half_height) / cell_m));
  for (int32_t row = row_low; row <= row_high; ++row) {
    const double y = row * cell_m - begin.y();
    double low = -1e12, high = 1e12;
    ClipInterval(normal.x(), normal.y() * y, -band_m, band_m, &low, &high);
    ClipInterval(along.x(), along.y() * y, -reach_m, length + reach_m, &low, &high);
    if (low > high) continue;
    const auto column_low = static_cast<int32_t>(std::ceil((low + begin.x()) / cell_m));
    const auto column_high = static_cast<int32_t>(std::floor((high + begin.x()) / cell_m));
    for (int32_t column = column_low; column <= column_high; ++column) {
      const double x = column * cell_m - begin.x();
      const double distance = normal.x() * x + normal.y() * y;
      const double t = along.x() * x + along.y() * y;
      const double past_end = std::max({0.0, -t, t - length});
      const double spread = options.distance_sigma * distance;
      const double end_spread = options.end_sigma * past_end;
      const double floor2 = options.sigma_floor_m * options.sigma_floor_m;
      const double fit = line.variance[0] + t * (line.variance[1] + t * line.variance[2]);
      const double variance = std::max(fit, 0.0) + floor2 + spread * spread + end_spread * end_spread;
      Offer({column, row, static_cast<float>(distance), static_cast<float>(1.0 / variance),
             static_cast<float>(std::sqrt(distance * distance + past_end * past_end)), sheet});
    }
  }
}

size_t ScanField::SlotOf(int32_t x, int32_t y, int32_t sheet) const {
  const uint64_t key = (static_cast<uint64_t>(static_cast<uint32_t>(x)) << 32) |
                       (static_cast<uint32_t>(y) ^ static_cast<uint32_t>(sheet) << 31);
  const size_t mask = slots_.size() - 1;
  size_t slot = (key * 0x9E3779B97F4A7C15ULL >> 40) & mask;
  while (slots_[slot].stamp == stamp_) {
    const VertexMeasurement& held = measurements_[slots_[slot].position];
    if (held.x == x && held.y == y && held.sheet == sheet) break;
    slot = (slot + 1) & mask;
  }
  return slot;
}

void ScanField::Offer(const VertexMeasurement& candidate) {
  Slot& slot = slots_[SlotOf(candidate.x, candidate.y, candidate.sheet)];
  if (slot.stamp == stamp_) {
    VertexMeasurement& held = measurements_[slot.position];
    if (candidate.remoteness_m < held.remoteness_m) held = candidate;
    return;
  }
  slot = {stamp_, static_cast<uint32_t>(measurements_.size())};
  measurements_.push_back(candidate);
  if (2 * measurements_.size() > slots_.size()) Grow();
}

void ScanField::Grow() {
  slots_.assign(2 * slots_.size(), Slot{});
  for (uint32_t i = 0; i < measurements_.size(); ++i) {
    slots_[SlotOf(measurements_[i].x, measurements_[i].y, measurements_[i].sheet)] = {stamp_, i};
  }
}

}  // namespace lcmslam::sdf2d
