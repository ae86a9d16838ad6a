#include "trajectory/map_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

namespace lcmslam {
namespace {

using Points = std::span<const Eigen::Vector3d>;

// What nanoflann asks of a set of points.
struct Cloud {
  Points points;
  size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(size_t i, size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// `to` is not empty.
std::vector<double> NearestDistances(Points from, Points to) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;
  const Cloud cloud{to};
  Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(20));
  tree.buildIndex();
  std::vector<double> distances_m;
  distances_m.reserve(from.size());
  for (const Eigen::Vector3d& point : from) {
    uint32_t index = 0;
    double square = 0.0;
    tree.knnSearch(point.data(), 1, &index, &square);
    distances_m.push_back(std::sqrt(square));
  }
  return distances_m;
}

// The first point of every cell.
std::vector<Eigen::Vector3d> Thin(Points points, double grid_m) {
  std::set<std::array<int64_t, 3>> taken;
  std::vector<Eigen::Vector3d> thinned;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d cell = (p / grid_m).array().floor();
    const std::array<int64_t, 3> index = {static_cast<int64_t>(cell.x()), static_cast<int64_t>(cell.y()),
                                          static_cast<int64_t>(cell.z())};
    if (taken.insert(index).second) thinned.push_back(p);
  }
  return thinned;
}

double ShareWithin(const std::vector<double>& distances_m, double within_m) {
  const auto near = std::ranges::count_if(distances_m, [&](double d) { return d <= within_m; });
  return static_cast<double>(near) / static_cast<double>(distances_m.size());
}

// Sums of the points of one square, relative to its corner.
struct Moments {
  size_t count = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();

  void Add(const Eigen::Vector2d& p) {
    ++count;
    sum += p;
    products += p * p.transpose();
  }
  // Variances along and across the best line, ascending.
  Eigen::Vector2d Variances() const {
    const double n = static_cast<double>(count);
    const Eigen::Vector2d mean = sum / n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(products / n - mean * mean.transpose(),
                                                                Eigen::EigenvaluesOnly);
    return solver.eigenvalues().cwiseMax(0.0);
  }
};

}  // namespace

std::string SurfaceQualityOptions::Validate() const {
  if (!(grid_m > 0.0)) return "grid_m: must be positive";
  const bool all_positive = std::ranges::all_of(completeness_m, [](double within_m) { return within_m > 0.0; });
  return all_positive ? "" : "completeness_m: must be positive";
}

std::string WallThicknessOptions::Validate() const {
  if (!(cell_m > 0.0)) return "cell_m: must be positive";
  if (min_points < 3) return "min_points: must be 3 or more";
  return max_flatness > 0.0 && max_flatness <= 1.0 ? "" : "max_flatness: must be in (0, 1]";
}

SurfaceQuality CompareSurfaces(Points mapped, Points truth, const SurfaceQualityOptions& options) {
  SurfaceQuality quality;
  if (!mapped.empty() && !truth.empty()) quality.distance_m = Summarize(NearestDistances(mapped, truth));
  const std::vector<Eigen::Vector3d> places = Thin(truth, options.grid_m);
  std::vector<double> to_map_m(places.size(), std::numeric_limits<double>::infinity());
  if (!mapped.empty()) to_map_m = NearestDistances(places, mapped);
  for (const double within_m : options.completeness_m) {
    quality.completeness.push_back({within_m, ShareWithin(to_map_m, within_m)});
  }
  return quality;
}

Summary WallThickness(std::span<const Eigen::Vector2d> points, const WallThicknessOptions& options) {
  std::map<std::pair<double, double>, Moments> squares;  // by lower left corner, in cells
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d corner = (p / options.cell_m).array().floor();
    squares[{corner.x(), corner.y()}].Add(p - options.cell_m * corner);
  }
  std::vector<double> thickness_m;
  for (const auto& [corner, moments] : squares) {
    if (moments.count < options.min_points) continue;
    const Eigen::Vector2d sd_m = moments.Variances().cwiseSqrt();
    if (sd_m[0] <= options.max_flatness * sd_m[1]) thickness_m.push_back(sd_m[0]);
  }
  return Summarize(std::move(thickness_m));
}

}  // namespace lcmslam
