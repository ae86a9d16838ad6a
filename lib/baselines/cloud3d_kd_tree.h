#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace lcmslam::cloud3d {

struct Neighbour {
  uint32_t index = 0;        // into KdTree::points()
  float distance_m2 = 0.0F;  // squared
};

// A kd-tree over points in space (nanoflann). It never changes once built: a new map needs a new tree, in O(n log n).
// Threads: Nearest() may run side by side.
class KdTree {
 public:
  KdTree();
  // Finite points, metres.
  explicit KdTree(std::vector<Eigen::Vector3f> points);
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;
  ~KdTree();

  // The found.size() nearest points that are less than max_distance_m away, nearest first, for a finite p; returns how
  // many there are. epsilon: a neighbour may be up to 1 + epsilon times as far as the one it is reported for.
  int Nearest(const Eigen::Vector3f& p, float max_distance_m, float epsilon, std::span<Neighbour> found) const;

  const std::vector<Eigen::Vector3f>& points() const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace lcmslam::cloud3d
