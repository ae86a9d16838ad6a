#pragma once

#include <span>

#include <Eigen/Core>

#include "octo3d/motion.h"
#include "octo3d/observability.h"
#include "octo3d/options.h"
#include "octo3d/patches.h"
#include "octo3d/surfel_map.h"

namespace lcmslam::octo3d {

// What is known of a state before the sweep: a mean and the information about its error (Difference()).
struct StateBelief {
  MotionState mean;
  Matrix12 information = Matrix12::Zero();
};

// A measured motion between the two states, from IMU or odometry; zero information where there is none.
struct RelativeMotion {
  Pose3 T_from_to;                        // in the body frame at `from`
  Vector6 information = Vector6::Zero();  // diagonal: translation 1/m^2, rotation 1/rad^2
};

enum class RegistrationStatus { kConverged, kIterationLimit, kTooFewPatches };

struct RegistrationResult {
  RegistrationStatus status = RegistrationStatus::kTooFewPatches;
  MotionSegment motion;                // over the sweep; the prediction when there were too few patches
  StateBelief belief;                  // of motion.to(), with `from` marginalized out
  StateBelief prediction;              // the same without the sweep's points
  Matrix6 measured = Matrix6::Zero();  // the sweep's own information about its pose: translation, rotation
  Directions unobservable{6, 0};       // what the sweep does not show
  int iterations = 0;
  int matched = 0;                   // patches that met a surfel
  double inlier_ratio = 0.0;         // of the matched: residual within the kernel
  double residual_m = 0.0;           // rms of the inliers
  double normalized_residual = 0.0;  // weighted rms over its prediction: about 1 when all is well
};

// A sweep's patches with their time: first_dt_us as in TimeSlots, duration from the last state to the sweep's end.
struct TimedPatches {
  std::span<const Patch> patches;
  int32_t first_dt_us = 0;
  double duration_s = 0.1;  // > 0
};

// The motion up to the sweep's end as it is expected: constant velocity, or the hint where there is one.
MotionSegment PredictMotion(const StateBelief& from, const RelativeMotion& hint, double duration_s);

// Continuous-time point-to-plane registration: Gauss-Newton on the states at both ends of the sweep,
//   sum_i w_i (n_i^T (T(t_i) p_i - q_i))^2 + |from - belief|^2 + |motion prior|^2 + |relative motion|^2,
// w_i = Geman-McClure weight / (range noise / count + plane variance + model error). The kernel's width starts at what
// the prediction leaves open and narrows to the noise. Directions the sweep does not observe (eigenvectors of its
// information with less than min_direction_share, after what the noise of the planes' normals adds to it) are reported;
// the priors hold them. Pure: same input, same output. Starts from `guess`.
[[nodiscard]] RegistrationResult Register(const SurfelMap& map, const TimedPatches& sweep, const StateBelief& from,
                                          const RelativeMotion& hint, const MotionSegment& guess,
                                          const RegistrationOptions& options);

}  // namespace lcmslam::octo3d
