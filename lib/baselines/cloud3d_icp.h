#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "baselines/cloud3d_cloud.h"
#include "baselines/cloud3d_map.h"
#include "baselines/tracking.h"
#include "geometry/pose3.h"

namespace lcmslam::cloud3d {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct IcpOptions {
  int neighbours = 3;                  // map points that a reading point is matched to
  double epsilon = 0.0;                // a match may be up to 1 + epsilon times as far as the nearest point
  double max_distance_m = 2.0;         // farther points do not match
  double trim_ratio = 0.85;            // of the matches, the nearest: the others are outliers
  double max_normal_angle_rad = 0.75;  // matches whose normals differ by more are outliers; 0: any may
  int max_iterations = 40;
  double min_step_m = 0.001;    // done when the last steps were on average shorter ...
  double min_step_rad = 0.001;  // ... and turned less
  int smoothed_steps = 3;       // so many last steps
  double min_overlap = 0.3;     // of the reading: with fewer points matched and kept, the pose is not to be had

  std::string Validate() const;  // "" or "field: reason"
};

// Covariance: translation, rotation vector; map axes, about the body's origin: inv(H) * sum r^2 / (n - 6) of the last
// step. Inlier ratio: matches kept / (points * neighbours), of the last step, the overlap. Residual: point to plane,
// over the matches kept, before the last step.
using IcpResult = Registered<Pose3, 6>;

// A point of the reading and one of the map.
struct Match {
  uint32_t reading = 0;
  uint32_t map = 0;
  float distance_m2 = 0.0F;  // squared
};
[[nodiscard]] std::vector<Match> FindMatches(const Map& map, const Cloud& reading_map, const IcpOptions& options);

// The nearest trim_ratio of the matches, in their order; of these, those whose normals agree.
[[nodiscard]] std::vector<Match> KeepInliers(const Map& map, const Cloud& reading_map, std::vector<Match> matches,
                                             const IcpOptions& options);

// The sums of one Gauss-Newton step on r = n . (p - q): p and its map point q with normal n.
struct NormalEquations {
  Matrix6 H = Matrix6::Zero();  // sum J^T J; J = dr / d(translation, rotation vector) = [n, (p - centre) x n]
  Vector6 b = Vector6::Zero();  // -sum J^T r
  double r2 = 0.0;              // sum r^2
};
// Rotations turn about `centre`.
[[nodiscard]] NormalEquations Linearize(const Map& map, const Cloud& reading_map, std::span<const Match> matches,
                                        const Eigen::Vector3d& centre);

// Iterative closest point, point to plane, as libpointmatcher's default chain does it (Pomerleau, Colas, Siegwart,
// Magnenat, "Comparing ICP variants on real-world data sets", Autonomous Robots 2013). Pure.
[[nodiscard]] IcpResult Icp(const Map& map, const Cloud& reading_body, const Pose3& T_map_body_guess,
                            const IcpOptions& options);

}  // namespace lcmslam::cloud3d
