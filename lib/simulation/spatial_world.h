#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "simulation/triangle_mesh.h"

namespace lcmslam {

struct Solid {
  TriangleMesh mesh;          // metres, world frame, finite
  float reflectivity = 0.5F;  // of light that meets the surface at a right angle, 0..1
};

// World frame; the direction has unit length.
struct SpatialRay {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
};

// Where a ray meets the world.
struct SpatialHit {
  float range_m = std::numeric_limits<float>::infinity();  // infinite where it meets nothing; the rest is then unset
  Eigen::Vector3f normal;                                  // unit length, towards the side the ray came from
  float reflectivity;
};

// A world of triangle meshes; rays are cast by Embree, to float precision (some 1e-6 of the coordinates).
// Immutable, hence safe from several threads. One instruction set is used on every x86-64 machine, so that results
// are the same on all.
class SpatialWorld {
 public:
  // `p_inside` is a point in the open air, from where the rest of it can be reached. Throws std::runtime_error when
  // Embree refuses.
  SpatialWorld(std::vector<Solid> solids, const Eigen::Vector3d& p_inside);
  ~SpatialWorld();
  SpatialWorld(SpatialWorld&&) noexcept;
  SpatialWorld& operator=(SpatialWorld&&) noexcept;

  // hits[i] is the nearest surface along rays[i]; sizes must be equal. Fastest when neighbours in `rays` start close to
  // each other, as the shots of one firing do.
  void CastRays(std::span<const SpatialRay> rays, std::span<SpatialHit> hits) const;

  // From `p_world` to the nearest surface, at most max_distance_m.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p_world, double max_distance_m) const;

  std::span<const Solid> solids() const;
  const Eigen::Vector3d& p_inside() const { return p_inside_; }

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
  Eigen::Vector3d p_inside_;
};

}  // namespace lcmslam
