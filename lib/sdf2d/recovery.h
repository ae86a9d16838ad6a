#pragma once

#include <span>

#include <Eigen/Core>

#include "sdf2d/registration.h"

namespace lcmslam::sdf2d {

// Poses around `prediction` that best explain the scan, by brute force on the coarse map (correlative scan matching),
// each refined on the coarse and then on the fine map; the one with most inliers. `search_m`, `search_rad`: half
// widths of the window. Pure.
[[nodiscard]] AlignResult SearchAround(const SdfMap& map, const SdfMap& coarse_map, std::span<const ScanPoint> points,
                                       const Eigen::Vector2d& origin_body, const NoiseModel& noise,
                                       const MotionState& prediction, double search_m, double search_rad,
                                       const RegistrationOptions& options);

// Registration on the coarse map, then on the fine one: a basin of convergence four times as wide. Pure.
[[nodiscard]] AlignResult AlignCoarseToFine(const SdfMap& map, const SdfMap& coarse_map,
                                            std::span<const ScanPoint> points, const Eigen::Vector2d& origin_body,
                                            const NoiseModel& noise, const MotionState& prediction,
                                            const RegistrationOptions& options);

}  // namespace lcmslam::sdf2d
