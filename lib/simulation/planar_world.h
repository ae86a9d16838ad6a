#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lcmslam {

// A straight piece of wall, seen from both sides. Metres, world frame.
struct Segment {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

// Where a ray meets the world.
struct SurfaceHit {
  double range_m = 0.0;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // unit length, towards the side the ray came from
};

// A planar world of wall segments. Rays are cast exactly (no stepping); a uniform grid (Amanatides and Woo, "A fast
// voxel traversal algorithm for ray tracing", 1987) keeps that fast. Immutable, hence safe from several threads.
// Coordinates must be finite. Metres.
class PlanarWorld {
 public:
  // `barriers` are not seen by rays, but count as obstacles: the edge of the known part of a map, say.
  explicit PlanarWorld(std::vector<Segment> walls, std::vector<Segment> barriers = {});

  // The nearest wall along a ray from `origin` in `direction` (unit length), none beyond max_range_m. Segments are
  // closed (two that share an end leave no gap); one parallel to the ray is not hit.
  [[nodiscard]] std::optional<SurfaceHit> CastRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                                  double max_range_m) const;

  // From `p` to the nearest wall or barrier, at most max_distance_m.
  [[nodiscard]] double Distance(const Eigen::Vector2d& p,
                                double max_distance_m = std::numeric_limits<double>::infinity()) const;

  std::span<const Segment> walls() const { return {segments_.data(), num_walls_}; }
  std::span<const Segment> barriers() const { return {segments_.data() + num_walls_, segments_.size() - num_walls_}; }
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }

 private:
  void BuildGrid();
  int CellIndex(double coordinate_m, int axis) const;  // clamped to the grid
  std::span<const uint32_t> SegmentsIn(int ix, int iy) const;

  std::vector<Segment> segments_;  // walls, then barriers
  size_t num_walls_ = 0;
  Eigen::AlignedBox2d bounds_;

  // Segments by grid cell: those of cell i are entries_[first_[i]] .. entries_[first_[i + 1]].
  Eigen::Vector2d grid_origin_ = Eigen::Vector2d::Zero();
  Eigen::Array2i grid_size_ = Eigen::Array2i::Ones();
  double cell_m_ = 1.0;
  std::vector<uint32_t> first_;
  std::vector<uint32_t> entries_;
};

// The outline of a box: length along its own x, width along its own y, turned by yaw about its centre.
std::vector<Segment> BoxOutline(const Eigen::Vector2d& center, double length_m, double width_m, double yaw_rad = 0.0);

// The segments between consecutive points; closed: also from the last to the first.
std::vector<Segment> Polyline(std::span<const Eigen::Vector2d> points, bool closed);

}  // namespace lcmslam
