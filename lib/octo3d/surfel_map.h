#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "octo3d/options.h"
#include "octo3d/point_statistics.h"

namespace lcmslam::octo3d {

// A flat piece of surface: one octree cell seen from outside. Map frame, metres.
struct Surfel {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();     // on the plane, within the cell
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  // unit, towards where it was last seen from
  float cell_m = 0.0F;                                // edge of its cell
  float thickness_m = 0.0F;                           // standard deviation across the plane
  uint32_t count = 0;                                 // points
};

// The plane that explains the surface near a point.
struct PlaneMatch {
  bool found = false;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, sign arbitrary
  double variance = 0.0;                             // m^2, of the plane's height at the point asked for
  double tilt_variance = 0.0;                        // rad^2, of the normal, towards any side
};

// One leaf as it is stored: its statistics and the place it was last seen from.
struct LeafRecord {
  std::array<uint16_t, 3> key = {};  // OctoMap's key
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  PointStatistics statistics;  // about the centre
  uint32_t viewpoint = 0;      // index into viewpoints()
};

// Surfels in an octree (OctoMap's), at `levels` scales at once: every cell keeps additive statistics of its points,
// parents the sum of their children, and a plane that is fitted anew when the points have grown by a fixed factor, so
// that an update costs the same whatever the size of the map. A hash beside the tree leads to the blocks (cells of the
// coarsest scale). Const members may be called from several threads at once, others not.
class SurfelMap {
 public:
  explicit SurfelMap(const MapOptions& options);  // Validate()d
  ~SurfelMap();
  SurfelMap(SurfelMap&&) noexcept;
  SurfelMap& operator=(SurfelMap&&) noexcept;

  // Adds points (map frame, m) that were seen from about `viewpoint`; makes one new revision. Non-finite points and
  // those farther out than the octree reaches (2^15 leaves) are skipped.
  void Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint);

  // The best known plane at p: of the cells around p, coarse to fine, the one whose plane is known best there; where
  // none is planar, the nearest face neighbour's. Not found for non-finite p. O(levels).
  PlaneMatch Find(const Eigen::Vector3d& p) const;
  // The same for many points, about twice as fast: planes[i] for points[i]; equal sizes.
  void Find(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes) const;

  // The plane of the surfel whose mean lies nearest to p, among the cells at `level` (0: leaves) around p and next to
  // it, and their children. Reaches at least one cell's edge far: for matching from a rough guess. About 10 to 50 times
  // as dear as Find().
  PlaneMatch FindNear(const Eigen::Vector3d& p, int level) const;

  // The finest planar cells that were fitted anew after `revision` (0: all). Order depends on the insertions only.
  std::vector<Surfel> ChangedSince(uint32_t revision) const;
  // About `count` surfels or more, from `turn` on, which is moved on: 0, then what came out, again and again, goes
  // round the whole map.
  std::vector<Surfel> InTurn(size_t& turn, size_t count) const;

  // Every leaf, sorted by key; Restore() builds the same map from them.
  std::vector<LeafRecord> Leaves() const;
  void Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> viewpoints);

  void Clear();

  uint32_t revision() const;
  size_t num_cells() const;  // of all scales that hold surfels
  size_t num_leaves() const;
  const std::vector<Eigen::Vector3f>& viewpoints() const;
  const MapOptions& options() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lcmslam::octo3d
