#pragma once

#include <random>

#include "baselines/cloud3d_cloud.h"

namespace lcmslam::cloud3d {

// `n` points on each of the six walls of a box of 6 x 5 x 3 m about the origin; normals inwards.
inline Cloud RoomCloud(int n, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&] { return static_cast<float>(random() >> 40) * 0x1p-23F - 1.0F; };
  const Eigen::Vector3f half(3.0F, 2.5F, 1.5F);
  Cloud cloud;
  for (int wall = 0; wall < 6; ++wall) {
    const float side = wall % 2 == 0 ? 1.0F : -1.0F;
    for (int i = 0; i < n; ++i) {
      Eigen::Vector3f p(draw(), draw(), draw());
      p[wall / 2] = side;
      cloud.points.push_back(p.cwiseProduct(half));
      cloud.normals.push_back(-side * Eigen::Vector3f::Unit(wall / 2));
    }
  }
  return cloud;
}

}  // namespace lcmslam::cloud3d
