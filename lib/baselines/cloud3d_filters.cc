#include "baselines/cloud3d_filters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Eigenvalues>

#include "baselines/cloud3d_kd_tree.h"

namespace lcmslam::cloud3d {
namespace {

constexpr double kMaxExtent_cells = 1 << 20;  // from the origin: three coordinates fit 64 bits
constexpr double kMinSpreadRatio = 1e-4;      // of the middle to the largest variance: less is a line

// Portable, unlike std::bernoulli_distribution.
bool Draw(double probability, std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53 < probability;
}

uint64_t CellKey(const Eigen::Vector3f& p, double cells_per_m) {
  uint64_t key = 0;
  for (const float coordinate : p) {
    const double cell = std::floor(coordinate * cells_per_m);
    key =
        key << 21 | static_cast<uint64_t>(std::clamp(cell, -kMaxExtent_cells, kMaxExtent_cells - 1) + kMaxExtent_cells);
  }
  return key;
}

// Zero where the points fix no plane.
Eigen::Vector3f FitNormal(const std::vector<Eigen::Vector3f>& points, std::span<const Neighbour> neighbours) {
  const Eigen::Vector3f origin = points[neighbours.front().index];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Neighbour& neighbour : neighbours) {
    const Eigen::Vector3d d = (points[neighbour.index] - origin).cast<double>();
    sum += d;
    squares += d * d.transpose();
  }
  const Eigen::Matrix3d scatter = squares - sum * sum.transpose() / static_cast<double>(neighbours.size());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  const Eigen::Vector3d& variances = solver.eigenvalues();
  if (!(variances(1) > kMinSpreadRatio * variances(2))) return Eigen::Vector3f::Zero();
  return solver.eigenvectors().col(0).cast<float>().normalized();
}

}  // namespace

std::string FilterOptions::Validate() const {
  if (!(min_range_m >= 0.0)) return "min_range_m: must not be negative";
  if (!(max_range_m > min_range_m && max_range_m <= 1000.0))
    return "max_range_m: must exceed min_range_m, at most 1000";
  if (!(keep_ratio > 0.0 && keep_ratio <= 1.0)) return "keep_ratio: must be in (0, 1]";
  if (!(voxel_m == 0.0 || (voxel_m >= 0.001 && voxel_m <= 100.0))) return "voxel_m: must be 0 or in [0.001, 100]";
  if (normal_neighbours < 3 || normal_neighbours > 100) return "normal_neighbours: must be in 3..100";
  return "";
}

std::vector<Eigen::Vector3f> ReturnsInRange(const Sweep& sweep, double min_range_m, double max_range_m) {
  const float min_m2 = static_cast<float>(min_range_m * min_range_m);
  const float max_m2 = static_cast<float>(max_range_m * max_range_m);
  std::vector<Eigen::Vector3f> points;
  points.reserve(sweep.points.size());
  for (const SweepPoint& point : sweep.points) {
    const Eigen::Vector3f p(point.x, point.y, point.z);
    const float range_m2 = p.squaredNorm();
    if (range_m2 >= min_m2 && range_m2 <= max_m2) points.push_back(p);  // false for NaN
  }
  return points;
}

std::vector<Eigen::Vector3f> RandomSample(std::vector<Eigen::Vector3f> points, double keep_ratio,
                                          std::mt19937_64& random) {
  if (keep_ratio < 1.0) std::erase_if(points, [&](const Eigen::Vector3f&) { return !Draw(keep_ratio, random); });
  return points;
}

Cloud RandomSample(Cloud cloud, double keep_ratio, std::mt19937_64& random) {
  if (keep_ratio >= 1.0) return cloud;
  size_t kept = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    if (!Draw(keep_ratio, random)) continue;
    cloud.points[kept] = cloud.points[i];
    cloud.normals[kept++] = cloud.normals[i];
  }
  cloud.points.resize(kept);
  cloud.normals.resize(kept);
  return cloud;
}

std::vector<Eigen::Vector3f> VoxelMeans(const std::vector<Eigen::Vector3f>& points, double voxel_m) {
  std::vector<std::pair<uint64_t, uint32_t>> order;  // cell, point
  order.reserve(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) order.emplace_back(CellKey(points[i], 1.0 / voxel_m), i);
  std::ranges::sort(order);
  std::vector<Eigen::Vector3f> means;
  for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (; end < order.size() && order[end].first == order[begin].first; ++end) {
      sum += points[order[end].second].cast<double>();
    }
    means.push_back((sum / static_cast<double>(end - begin)).cast<float>());
  }
  return means;
}

Cloud WithNormals(std::vector<Eigen::Vector3f> points, int neighbours) {
  const KdTree tree(std::move(points));
  Cloud cloud;
  cloud.points.reserve(tree.points().size());
  cloud.normals.reserve(tree.points().size());
  std::vector<Neighbour> found(neighbours);
  for (const Eigen::Vector3f& p : tree.points()) {
    const int count = tree.Nearest(p, std::numeric_limits<float>::max(), 0.0F, found);
    const Eigen::Vector3f normal = FitNormal(tree.points(), std::span(found).first(count));
    if (normal.isZero()) continue;
    cloud.points.push_back(p);
    cloud.normals.push_back(normal.dot(p) <= 0.0F ? normal : -normal);
  }
  return cloud;
}

Cloud Filter(const Sweep& sweep, const FilterOptions& options, std::mt19937_64& random) {
  std::vector<Eigen::Vector3f> points = ReturnsInRange(sweep, options.min_range_m, options.max_range_m);
  points = RandomSample(std::move(points), options.keep_ratio, random);
  if (options.voxel_m > 0.0) points = VoxelMeans(points, options.voxel_m);
  return WithNormals(std::move(points), options.normal_neighbours);
}

}  // namespace lcmslam::cloud3d
