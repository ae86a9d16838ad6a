#pragma once

#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"

namespace lcmslam::cloud3d {

// Points (metres) with one unit normal each.
struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;

  size_t size() const { return points.size(); }
};

// The cloud in frame a, given in frame b.
[[nodiscard]] Cloud Transformed(const Pose3& T_a_b, Cloud cloud_b);

}  // namespace lcmslam::cloud3d
