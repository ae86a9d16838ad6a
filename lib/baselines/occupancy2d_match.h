#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

#include "baselines/occupancy2d_grid.h"
#include "baselines/tracking.h"
#include "geometry/pose2.h"

namespace lcmslam::occupancy2d {

struct MatchOptions {
  int coarse_steps = 4;  // on every level but the finest
  int fine_steps = 6;
  double max_rotation_step_rad = 0.2;
  LogOddsGrid::Gradient gradient = LogOddsGrid::Gradient::kExact;

  std::string Validate() const;  // "" or "field: reason"
};

// On the finest level. Covariance: x, y, yaw; map axes, about the body's origin: inv(H) * sum r^2 / (n - 3) of the last
// step. Inliers: points that lie where M > 0.5. Residual: first-order distance to M = 1.
using MatchResult = Registered<Pose2, 3>;

// The sums of one Gauss-Newton step on the residuals r = 1 - M(T_map_body p).
struct NormalEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  // sum J^T J; J = dM(T p) / d(x, y, yaw), = -dr / d(x, y, yaw)
  Eigen::Vector3d b = Eigen::Vector3d::Zero();  // sum J^T r
  double r2 = 0.0;                              // sum r^2
};
NormalEquations Linearize(const LogOddsGrid& grid, std::span<const Eigen::Vector2d> p_body, const Pose2& T_map_body,
                          LogOddsGrid::Gradient gradient);

// Places a scan's end points (body frame, metres, finite) on the map, coarsest level first. `levels` runs from fine to
// coarse and has at least one. A fixed number of steps, no damping, no robust kernel: Kohlbrecher, von Stryk, Meyer,
// Klingauf, "A Flexible and Scalable SLAM System with Full 3D Motion Estimation", SSRR 2011, equations 7-14. Pure.
[[nodiscard]] MatchResult Match(std::span<const LogOddsGrid> levels, std::span<const Eigen::Vector2d> p_body,
                                const Pose2& T_map_body_guess, const MatchOptions& options);

}  // namespace lcmslam::occupancy2d
