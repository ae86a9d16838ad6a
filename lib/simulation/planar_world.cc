#include "simulation/planar_world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lcmslam {
namespace {

using Eigen::Vector2d;

constexpr double kRelativeTolerance = 1e-12;  // of a segment's length: neighbours overlap by this, and leave no gap
constexpr double kGridMargin_m = 1e-6;        // segments are filed in every cell they come this close to
constexpr double kCellsPerSegment = 8.0;
constexpr int kMaxCellsPerSide = 2000;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The distance along the ray to the segment, or infinity.
double RangeTo(const Segment& segment, const Vector2d& origin, const Vector2d& direction) {
  const Vector2d along = segment.b - segment.a;
  const Vector2d to_a = segment.a - origin;
  const double denominator = Cross(direction, along);
  if (denominator == 0.0) return std::numeric_limits<double>::infinity();
  const double range = Cross(to_a, along) / denominator;
  const double fraction = Cross(to_a, direction) / denominator;
  const bool hit = range >= 0.0 && fraction >= -kRelativeTolerance && fraction <= 1.0 + kRelativeTolerance;
  return hit ? range : std::numeric_limits<double>::infinity();
}

double DistanceTo(const Segment& segment, const Vector2d& p) {
  const Vector2d along = segment.b - segment.a;
  const double squared_length = along.squaredNorm();
  const double fraction = squared_length > 0.0 ? (p - segment.a).dot(along) / squared_length : 0.0;
  return (segment.a + std::clamp(fraction, 0.0, 1.0) * along - p).norm();
}

Vector2d NormalAgainst(const Segment& segment, const Vector2d& direction) {
  const Vector2d along = (segment.b - segment.a).normalized();
  const Vector2d normal(-along.y(), along.x());
  return normal.dot(direction) > 0.0 ? Vector2d(-normal) : normal;
}

// Whether the segment touches the axis-parallel square (separating axis test; the square's own axes are the caller's).
bool CrossesSquare(const Segment& segment, const Vector2d& center, double half_side_m) {
  const Vector2d along = segment.b - segment.a;
  const double reach = half_side_m * (std::abs(along.x()) + std::abs(along.y()));
  return std::abs(Cross(along, center - segment.a)) <= reach;
}

}  // namespace

PlanarWorld::PlanarWorld(std::vector<Segment> walls, std::vector<Segment> barriers)
    : segments_(std::move(walls)), num_walls_(segments_.size()) {
  segments_.insert(segments_.end(), barriers.begin(), barriers.end());
  for (const Segment& segment : segments_) bounds_.extend(segment.a).extend(segment.b);
  BuildGrid();
}

void PlanarWorld::BuildGrid() {
  if (segments_.empty()) {
    first_ = {0, 0};
    return;
  }
  const Vector2d margin = Vector2d::Constant(2.0 * kGridMargin_m);
  const Vector2d extent = bounds_.sizes() + 2.0 * margin;
  const double wanted_cells = kCellsPerSegment * static_cast<double>(segments_.size());
  cell_m_ = std::max(std::sqrt(extent.prod() / wanted_cells), extent.maxCoeff() / kMaxCellsPerSide);
  grid_origin_ = bounds_.min() - margin;
  grid_size_ = (extent / cell_m_).array().ceil().cast<int>().max(1);

  std::vector<std::pair<uint32_t, uint32_t>> filed;  // cell, segment
  for (uint32_t i = 0; i < segments_.size(); ++i) {
    const Vector2d low = segments_[i].a.cwiseMin(segments_[i].b) - margin;
    const Vector2d high = segments_[i].a.cwiseMax(segments_[i].b) + margin;
    for (int iy = CellIndex(low.y(), 1); iy <= CellIndex(high.y(), 1); ++iy) {
      for (int ix = CellIndex(low.x(), 0); ix <= CellIndex(high.x(), 0); ++ix) {
        const Vector2d center = grid_origin_ + cell_m_ * Vector2d(ix + 0.5, iy + 0.5);
        if (!CrossesSquare(segments_[i], center, 0.5 * cell_m_ + kGridMargin_m)) continue;
        filed.emplace_back(static_cast<uint32_t>(iy * grid_size_.x() + ix), i);
      }
    }
  }
  std::sort(filed.begin(), filed.end());
  first_.assign(static_cast<size_t>(grid_size_.prod()) + 1, 0);
  for (const auto& [cell, segment] : filed) {
    ++first_[cell + 1];
    entries_.push_back(segment);
  }
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

int PlanarWorld::CellIndex(double coordinate_m, int axis) const {
  const double index = std::floor((coordinate_m - grid_origin_[axis]) / cell_m_);
  return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(grid_size_[axis] - 1)));
}

std::span<const uint32_t> PlanarWorld::SegmentsIn(int ix, int iy) const {
  const int cell = iy * grid_size_.x() + ix;
  const uint32_t* const first = &first_[static_cast<size_t>(cell)];
  return {entries_.data() + first[0], first[1] - first[0]};
}

std::optional<SurfaceHit> PlanarWorld::CastRay(const Vector2d& origin, const Vector2d& direction,
                                               double max_range_m) const {
  // The part of the ray inside the grid, entered from outside if need be.
  double enter_m = 0.0;
  double leave_m = max_range_m;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = grid_origin_[axis] - origin[axis];
    const double high = low + grid_size_[axis] * cell_m_;
    if (direction[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    const auto [near, far] = std::minmax({low / direction[axis], high / direction[axis]});
    enter_m = std::max(enter_m, near);
    leave_m = std::min(leave_m, far);
  }
  if (!(enter_m <= leave_m)) return std::nullopt;

  const Vector2d entry = origin + enter_m * direction;
  std::array<int, 2> cell{CellIndex(entry.x(), 0), CellIndex(entry.y(), 1)};
  std::array<double, 2> next_m{};  // range at which the ray leaves the cell along each axis
  std::array<double, 2> stride_m{};
  std::array<int, 2> step{};
  for (int axis = 0; axis < 2; ++axis) {
    step[axis] = direction[axis] > 0.0 ? 1 : -1;
    const double border = grid_origin_[axis] + (cell[axis] + (step[axis] > 0 ? 1 : 0)) * cell_m_;
    const bool crosses = direction[axis] != 0.0;
    next_m[axis] = crosses ? (border - origin[axis]) / direction[axis] : std::numeric_limits<double>::infinity();
    stride_m[axis] = crosses ? cell_m_ / std::abs(direction[axis]) : 0.0;
  }

  double best_m = std::numeric_limits<double>::infinity();
  uint32_t best = 0;
  while (true) {
    for (const uint32_t i : SegmentsIn(cell[0], cell[1])) {
      if (i >= num_walls_) break;  // entries are sorted, barriers last
      const double range_m = RangeTo(segments_[i], origin, direction);
      if (range_m < best_m) {
        best_m = range_m;
        best = i;
      }
    }
    const int axis = next_m[0] < next_m[1] ? 0 : 1;
    if (best_m <= next_m[axis] || next_m[axis] > leave_m) break;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= grid_size_[axis]) break;
    next_m[axis] += stride_m[axis];
  }
  if (!(best_m <= max_range_m)) return std::nullopt;
  return SurfaceHit{best_m, NormalAgainst(segments_[best], direction)};
}

double PlanarWorld::Distance(const Vector2d& p, double max_distance_m) const {
  if (segments_.empty()) return max_distance_m;
  double best_m = max_distance_m;
  const int cx = CellIndex(p.x(), 0);
  const int cy = CellIndex(p.y(), 1);
  // Square rings of cells around p; whatever lies in ring r or beyond is at least (r - 1) cells away.
  for (int ring = 0; ring < grid_size_.maxCoeff() && (ring - 1) * cell_m_ < best_m; ++ring) {
    for (int iy = std::max(cy - ring, 0); iy <= std::min(cy + ring, grid_size_.y() - 1); ++iy) {
      const bool whole_row = std::abs(iy - cy) == ring;
      for (int ix = cx - ring; ix <= cx + ring; ix += whole_row || ring == 0 ? 1 : 2 * ring) {
        if (ix < 0 || ix >= grid_size_.x()) continue;
        for (const uint32_t i : SegmentsIn(ix, iy)) best_m = std::min(best_m, DistanceTo(segments_[i], p));
      }
    }
  }
  return best_m;
}

std::vector<Segment> BoxOutline(const Vector2d& center, double length_m, double width_m, double yaw_rad) {
  const Vector2d along = 0.5 * length_m * Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
  const Vector2d across = 0.5 * width_m * Vector2d(-std::sin(yaw_rad), std::cos(yaw_rad));
  const std::array<Vector2d, 4> corners{center - along - across, center + along - across, center + along + across,
                                        center - along + across};
  return Polyline(corners, true);
}

std::vector<Segment> Polyline(std::span<const Vector2d> points, bool closed) {
  std::vector<Segment> segments;
  for (size_t i = 1; i < points.size(); ++i) segments.push_back({points[i - 1], points[i]});
  if (closed && points.size() > 2) segments.push_back({points.back(), points.front()});
  return segments;
}

}  // namespace lcmslam
