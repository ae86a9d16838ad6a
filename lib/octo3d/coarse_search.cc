#include "octo3d/coarse_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "lidar/pose_table.h"

namespace lcmslam::octo3d {

namespace {

// Patches in the body frame at the sweep's end.
std::vector<Eigen::Vector3d> Deskewed(const TimedPatches& sweep, const MotionSegment& motion, size_t max_patches) {
  const double sweep_us = 1e6 * sweep.duration_s;
  const Pose3 T_end_map = motion.At(1.0).inverse();
  const PoseTable poses(TimeSlots(sweep.first_dt_us),
                        [&](double dt_us) { return T_end_map * motion.At(1.0 + dt_us / sweep_us); });
  const size_t size = sweep.patches.size(), wanted = std::min(size, max_patches);
  std::vector<Eigen::Vector3d> points(wanted);
  for (size_t i = 0; i < wanted; ++i) {
    const Patch& patch = sweep.patches[i * size / wanted];
    points[i] = poses[patch.slot] * patch.mean;
  }
  return points;
}

// The coarsest level whose cells are no larger than `reach`.
int LevelFor(const MapOptions& map, double reach_m) {
  int level = 0;
  while (level + 1 < map.levels && map.leaf_m * (2 << level) <= reach_m) ++level;
  return level;
}

}  // namespace

CoarseSearchResult SearchCoarsely(const SurfelMap& map, const TimedPatches& sweep, const MotionSegment& guess,
                                  const CoarseSearchOptions& options) {
  const std::vector<Eigen::Vector3d> points = Deskewed(sweep, guess, static_cast<size_t>(options.max_patches));
  CoarseSearchResult result{guess.to().T_map_body};
  const double narrowest_m = 3.0 * map.options().range_noise_m;
  double kernel_m = options.reach_m;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    Matrix6 H = 1e-6 * Matrix6::Identity();  // solvable whatever the scene; the search only makes a guess
    Vector6 b = Vector6::Zero();
    int inliers = 0;
    const int level = LevelFor(map.options(), std::max(kernel_m, 0.5 * options.reach_m));
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d lever = result.T_map_body.rotation * point;
      const Eigen::Vector3d p = lever + result.T_map_body.translation;
      const PlaneMatch plane = map.FindNear(p, level);
      if (!plane.found) continue;
      const double residual = plane.normal.dot(p - plane.mean);
      const double ratio = kernel_m * kernel_m / (kernel_m * kernel_m + residual * residual);
      Vector6 J;
      J << plane.normal, lever.cross(plane.normal);
      H += ratio * ratio * J * J.transpose();
      b += ratio * ratio * residual * J;
      inliers += std::abs(residual) < narrowest_m;
    }
    result.inlier_ratio = points.empty() ? 0.0 : static_cast<double>(inliers) / static_cast<double>(points.size());
    const Vector6 delta = -H.ldlt().solve(b);
    result.T_map_body.translation += delta.head<3>();
    result.T_map_body.rotation = (ExpRotation(delta.tail<3>()) * result.T_map_body.rotation).normalized();
    const bool narrow = kernel_m <= narrowest_m;
    if (narrow && delta.head<3>().norm() < 1e-3 && delta.tail<3>().norm() < 1e-3) break;
    kernel_m = std::max(0.8 * kernel_m, narrowest_m);
  }
  return result;
}

}  // namespace lcmslam::octo3d
