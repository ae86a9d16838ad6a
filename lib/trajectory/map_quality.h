#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "trajectory/summary.h"

namespace lcmslam {

struct SurfaceQualityOptions {
  std::vector<double> completeness_m = {0.02, 0.05, 0.10};
  double grid_m = 0.01;          // however often a place was seen, it counts once for each cell of this size
  std::string Validate() const;  // "" or "field: reason"
};

struct Completeness {
  double within_m = 0.0;
  double share = 0.0;  // of the true surface that has a mapped one so near; NaN without true surface
};

struct SurfaceQuality {
  Summary distance_m;  // from each mapped point to the nearest true one
  std::vector<Completeness> completeness;
};

// How well a mapped surface lies on the true one, both as dense points in the same frame (planar ones with z = 0): the
// distances are those of points, so they are too large by what the points lie apart. Points are finite. Pure;
// O((n + m) log(n + m)).
[[nodiscard]] SurfaceQuality CompareSurfaces(std::span<const Eigen::Vector3d> mapped,
                                             std::span<const Eigen::Vector3d> truth,
                                             const SurfaceQualityOptions& options = {});

struct WallThicknessOptions {
  double cell_m = 0.5;           // the plane is cut into squares of this size
  size_t min_points = 100;       // fewer in a square say little
  double max_flatness = 0.25;    // of thickness over extent: rounder heaps are corners and furniture, no walls
  std::string Validate() const;  // "" or "field: reason"
};

// How thick walls are drawn where nothing true is known: the end points of all scans, moved to the map frame by the
// estimate, are cut into squares; the thickness of a wall is the standard deviation across the line that fits its
// square best (total least squares). One entry a square. Contains the sensor's noise: for comparing estimates of the
// same scans. Points are finite. Pure; O(n).
[[nodiscard]] Summary WallThickness(std::span<const Eigen::Vector2d> points, const WallThicknessOptions& options = {});

}  // namespace lcmslam
