#pragma once

#include <span>
#include <string>
#include <vector>

#include "trajectory/association.h"

namespace lcmslam {

// Errors of many poses, one entry each, in the order of the pairs they came from.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;  // angle of the rotation between, in [0, pi]

  void Reserve(size_t count);
  void Add(const Pose3& reference, const Pose3& estimate);
};

// Absolute trajectory error: |p_reference - p_estimate| and the angle between, of every pair. The estimates have been
// aligned (Apply in alignment.h).
[[nodiscard]] PoseErrors AbsoluteErrors(std::span<const PosePair> pairs);

// Length of the path of one side to each pair, m; from 0.
[[nodiscard]] std::vector<double> PathLengths(std::span<const PosePair> pairs,
                                              Pose3 PosePair::*side = &PosePair::reference);

// A pair (i, j) of a relative error reaches its step to within this share of the step.
inline constexpr double kStepTolerance = 0.2;

// Relative pose error (Sturm et al. 2012): the error (R_i^-1 R_j)^-1 (E_i^-1 E_j) of the motion from each pose i to the
// pose j > i nearest to t_i + step: the last before that or the first from it on, the former when equally near. Poses
// without such a j within kStepTolerance are left out. step_s > 0. O(n).
[[nodiscard]] PoseErrors RelativeErrorsOverTime(std::span<const PosePair> pairs, double step_s);
// The same where step and nearness are path length along the reference: path_m = PathLengths(pairs).
[[nodiscard]] PoseErrors RelativeErrorsOverDistance(std::span<const PosePair> pairs, std::span<const double> path_m,
                                                    double step_m);

// The KITTI odometry measure (Geiger et al. 2012; its devkit's evaluate_odometry.cpp): from every tenth pose to the
// first that is more than 100, 200, ... 800 m further along the reference, error over nominal length. No entries for
// runs below 100 m.
struct KittiErrors {
  std::vector<double> translation_ratio;  // m per m; times 100 is KITTI's percentage
  std::vector<double> rotation_rad_per_m;
};
[[nodiscard]] KittiErrors KittiSegmentErrors(std::span<const PosePair> pairs, std::span<const double> path_m);

// Relative error from the first pose to the last over the reference's path length. NaN without motion.
struct Drift {
  double path_length_m = 0.0;
  double translation_m_per_m = 0.0;
  double rotation_rad_per_m = 0.0;
};
[[nodiscard]] Drift DriftPerMetre(std::span<const PosePair> pairs, std::span<const double> path_m);

}  // namespace lcmslam
