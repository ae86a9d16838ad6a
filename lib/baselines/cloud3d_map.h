#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "baselines/cloud3d_cloud.h"
#include "baselines/cloud3d_kd_tree.h"

namespace lcmslam::cloud3d {

struct MapOptions {
  double spacing_m = 0.05;  // a point comes in when it is at least this far from all others

  std::string Validate() const;  // "" or "field: reason"
};

// The map: points with normals and the kd-tree over them, which is built anew when points came in and only then.
// Threads: const members may run side by side.
class Map {
 public:
  explicit Map(const MapOptions& options) : options_(options) {}

  // Takes in what the map lacks of a cloud in the map frame, in the cloud's order, points that are not finite left
  // out; returns how many points that were.
  int Grow(const Cloud& cloud_map);

  const KdTree& tree() const { return tree_; }
  const std::vector<Eigen::Vector3f>& points() const { return tree_.points(); }
  const std::vector<Eigen::Vector3f>& normals() const { return normals_; }  // unit, one for each point
  size_t size() const { return normals_.size(); }

 private:
  MapOptions options_;
  KdTree tree_;
  std::vector<Eigen::Vector3f> normals_;
};

// Points with normals as binary little-endian PLY: x y z nx ny nz.
void WritePly(const Map& map, std::ostream& out);

}  // namespace lcmslam::cloud3d
