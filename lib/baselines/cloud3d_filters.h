#pragma once

#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "baselines/cloud3d_cloud.h"
#include "lidar/sweep.h"

namespace lcmslam::cloud3d {

// The chain that every sweep passes, in this order.
struct FilterOptions {
  double min_range_m = 0.3;    // nearer returns are ignored
  double max_range_m = 100.0;  // farther ones, too
  double keep_ratio = 1.0;     // of the returns, drawn at random; 0..1
  double voxel_m = 0.1;        // edge of the cells whose points are replaced by their mean; 0: none are
  int normal_neighbours = 12;  // points a normal is fitted to, itself included

  std::string Validate() const;  // "" or "field: reason"
};

// The finite returns within range, in the sweep's order.
[[nodiscard]] std::vector<Eigen::Vector3f> ReturnsInRange(const Sweep& sweep, double min_range_m, double max_range_m);

// Each element with probability keep_ratio, in order.
[[nodiscard]] std::vector<Eigen::Vector3f> RandomSample(std::vector<Eigen::Vector3f> points, double keep_ratio,
                                                        std::mt19937_64& random);
[[nodiscard]] Cloud RandomSample(Cloud cloud, double keep_ratio, std::mt19937_64& random);

// The mean of the points in each cell of a grid with one corner at the origin, in the order of x, y, z of the cells.
[[nodiscard]] std::vector<Eigen::Vector3f> VoxelMeans(const std::vector<Eigen::Vector3f>& points, double voxel_m);

// Each point with the normal of the plane through its `neighbours` nearest points (least squares), turned towards the
// origin. Points whose neighbours fix no plane are left out.
[[nodiscard]] Cloud WithNormals(std::vector<Eigen::Vector3f> points, int neighbours);

// The whole chain: the sweep as a cloud in the lidar's frame. As in the original the points' times are not used.
[[nodiscard]] Cloud Filter(const Sweep& sweep, const FilterOptions& options, std::mt19937_64& random);

}  // namespace lcmslam::cloud3d
