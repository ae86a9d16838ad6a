#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/spatial_world.h"

namespace lcmslam {

struct TestRay {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
};

struct TestHit {
  float range_m;
  Eigen::Vector3f normal;  // towards the ray's origin
  float reflectivity;
};

inline std::vector<TestHit> CastRays(const SpatialWorld& world, const std::vector<TestRay>& rays) {
  SpatialRays side_by_side(static_cast<Eigen::Index>(rays.size()));
  for (size_t i = 0; i < rays.size(); ++i) {
    side_by_side.origins.row(static_cast<Eigen::Index>(i)) = rays[i].origin;
    side_by_side.directions.row(static_cast<Eigen::Index>(i)) = rays[i].direction;
  }
  SpatialHits hits(side_by_side.size());
  world.CastRays(side_by_side, hits);
  std::vector<TestHit> result;
  for (const TestRay& ray : rays) {
    const auto i = static_cast<Eigen::Index>(result.size());
    const auto& [normal, reflectivity] = world.facets()[hits.facets[i]];
    const float side = normal.dot(ray.direction) > 0.0F ? -1.0F : 1.0F;
    result.push_back({hits.ranges_m[i], side * normal, reflectivity});
  }
  return result;
}

}  // namespace lcmslam
