#pragma once

#include <vector>

#include <Eigen/Core>

#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// Points on the mapped surfaces, at most spacing_m (> 0) apart: where the distances of a sheet change sign between
// neighbouring vertices, joined by a straight line within each cell whose four corners are known (marching squares).
// Map frame, m. Deterministic: tiles, sheets and cells in their order.
[[nodiscard]] std::vector<Eigen::Vector2d> Contour(const SdfMap& map, double spacing_m);

}  // namespace lcmslam::sdf2d
