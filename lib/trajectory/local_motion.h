#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "geometry/trajectory.h"

namespace lcmslam {

// A trajectory near one moment as polynomials of second degree, fitted by least squares: the noise of single poses
// averages out, which differences of neighbouring poses would magnify.
struct LocalMotion {
  // Columns: constant, linear and quadratic coefficient in s = (t - moment) / half_width.
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 4, 3> quaternion = Eigen::Matrix<double, 4, 3>::Zero();  // rows x, y, z, w; to be normalized
  double half_width_s = 0.0;
};

// Fits the poses within half_width_us of `utime`. None with fewer than four of them, none on one of the sides, or a
// gap of more than max_gap_us around it. O(log n + poses in the window).
[[nodiscard]] std::optional<LocalMotion> FitLocalMotion(std::span<const StampedPose> trajectory, int64_t utime,
                                                        int64_t half_width_us, int64_t max_gap_us);

}  // namespace lcmslam
