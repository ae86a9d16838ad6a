#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "simulation/triangle_mesh.h"

namespace lcmslam {

struct Solid {
  TriangleMesh mesh;          // metres, world frame, finite
  float reflectivity = 0.5F;  // of light that meets the surface at a right angle, 0..1
};

// Rays side by side: row i is ray i. World frame; directions have unit length.
struct SpatialRays {
  explicit SpatialRays(Eigen::Index count) : origins(count, 3), directions(count, 3) {}

  Eigen::Index size() const { return origins.rows(); }

  Eigen::ArrayX3f origins;
  Eigen::ArrayX3f directions;
};

// One triangle of the world, as light meets it.
struct Facet {
  Eigen::Vector3f normal;  // unit length, to either side; zero where the triangle has no area
  float reflectivity;
};

// Where rays meet the world: element i belongs to ray i.
struct SpatialHits {
  explicit SpatialHits(Eigen::Index count) : ranges_m(count), facets(count) {}

  Eigen::ArrayXf ranges_m;                           // infinite where a ray meets nothing
  Eigen::Array<unsigned, Eigen::Dynamic, 1> facets;  // index into SpatialWorld::facets()
};

// A world of triangle meshes; rays are cast by Embree, to float precision (some 1e-6 of the coordinates).
// About one ray in a million slips through a seam between triangles. Immutable, hence safe from several threads. One
// instruction set, SSE 4.2, is used on every x86-64 machine, so that results are the same on all.
class SpatialWorld {
 public:
  // `p_inside` is a point in the open air, from where the rest of it can be reached. Throws std::runtime_error when
  // Embree refuses.
  SpatialWorld(const std::vector<Solid>& solids, const Eigen::Vector3d& p_inside);
  ~SpatialWorld();
  SpatialWorld(SpatialWorld&&) noexcept;
  SpatialWorld& operator=(SpatialWorld&&) noexcept;

  // The nearest surface along each ray; sizes must be equal. Fastest when each 64 neighbours form a narrow bundle.
  void CastRays(const SpatialRays& rays, SpatialHits& hits) const;
  // The last one stands for nothing: zeros.
  std::span<const Facet> facets() const;

  // From `p_world` to the nearest surface, at most max_distance_m.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p_world, double max_distance_m) const;

  const Eigen::Vector3d& p_inside() const { return p_inside_; }
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }  // of all surfaces

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
  Eigen::Vector3d p_inside_;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace lcmslam
