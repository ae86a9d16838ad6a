#include "baselines/occupancy2d_match.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace lcmslam::occupancy2d {
namespace {

constexpr double kMinPivotRatio = 1e-12;

// One undamped step; false where the sums do not fix the pose.
bool Step(const NormalEquations& sums, double max_rotation_step_rad, Pose2* T_map_body) {
  const Eigen::LDLT<Eigen::Matrix3d> factor(sums.H);
  const Eigen::Vector3d pivots = factor.vectorD();
  if (!(pivots.minCoeff() > kMinPivotRatio * pivots.maxCoeff())) return false;
  const Eigen::Vector3d step = factor.solve(sums.b);
  const double rotation = std::clamp(step.z(), -max_rotation_step_rad, max_rotation_step_rad);
  *T_map_body = Pose2(T_map_body->translation() + step.head<2>(), T_map_body->yaw() + rotation);
  return T_map_body->IsFinite();
}

// How well the scan lies on the map where it was put.
void Judge(const LogOddsGrid& grid, std::span<const Eigen::Vector2d> p_body, MatchResult* result) {
  int inliers = 0;
  double r2 = 0.0, slope2 = 0.0;
  for (const Eigen::Vector2d& p : p_body) {
    const auto [probability, slope] = grid.At(result->T_map_body * p, LogOddsGrid::Gradient::kExact);
    if (probability <= 0.5) continue;
    ++inliers;
    r2 += (1.0 - probability) * (1.0 - probability);
    slope2 += slope.squaredNorm();
  }
  result->inlier_ratio = inliers / static_cast<double>(p_body.size());
  if (slope2 > 0.0) result->residual_rms_m = std::sqrt(r2 / slope2);
}

}  // namespace

std::string MatchOptions::Validate() const {
  if (coarse_steps < 1 || coarse_steps > 100) return "coarse_steps: must be in 1..100";
  if (fine_steps < 1 || fine_steps > 100) return "fine_steps: must be in 1..100";
  if (!(max_rotation_step_rad > 0.0)) return "max_rotation_step_rad: must be positive";
  return "";
}

NormalEquations Linearize(const LogOddsGrid& grid, std::span<const Eigen::Vector2d> p_body, const Pose2& T_map_body,
                          LogOddsGrid::Gradient gradient) {
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0, xr = 0.0, yr = 0.0, tr = 0.0, rr = 0.0;
  for (const Eigen::Vector2d& p : p_body) {
    const Eigen::Vector2d p_map = T_map_body * p;
    const auto [probability, slope] = grid.At(p_map, gradient);
    const Eigen::Vector2d lever = p_map - T_map_body.translation();
    const double x = slope.x(), y = slope.y(), t = y * lever.x() - x * lever.y(), r = 1.0 - probability;
    xx += x * x, xy += x * y, xt += x * t, yy += y * y, yt += y * t, tt += t * t;
    xr += x * r, yr += y * r, tr += t * r, rr += r * r;
  }
  NormalEquations sums;
  sums.H << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  sums.b << xr, yr, tr;
  sums.r2 = rr;
  return sums;
}

MatchResult Match(std::span<const LogOddsGrid> levels, std::span<const Eigen::Vector2d> p_body,
                  const Pose2& T_map_body_guess, const MatchOptions& options) {
  MatchResult result{.T_map_body = T_map_body_guess};
  NormalEquations sums;
  for (size_t level = levels.size(); level-- > 0;) {
    const int steps = level == 0 ? options.fine_steps : options.coarse_steps;
    for (int i = 0; i < steps; ++i) {
      sums = Linearize(levels[level], p_body, result.T_map_body, options.gradient);
      if (!Step(sums, options.max_rotation_step_rad, &result.T_map_body)) {
        result.T_map_body = T_map_body_guess;
        return result;
      }
      ++result.iterations;
    }
  }
  result.solved = true;
  result.covariance = sums.H.inverse() * (sums.r2 / std::max(1.0, static_cast<double>(p_body.size()) - 3.0));
  Judge(levels.front(), p_body, &result);
  return result;
}

}  // namespace lcmslam::occupancy2d
