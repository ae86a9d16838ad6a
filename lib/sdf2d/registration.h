#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lidar/deskew.h"
#include "sdf2d/motion_model.h"
#include "sdf2d/noise_model.h"
#include "sdf2d/options.h"
#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

enum class AlignStatus { kConverged, kIterationLimit, kTooFewPoints };

struct AlignResult {
  AlignStatus status = AlignStatus::kTooFewPoints;
  MotionState state;                                      // the prediction where too few points matched
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of the pose from this scan alone, body frame
  Eigen::Matrix3d unobservable =
      Eigen::Matrix3d::Zero();  // projector onto pose directions that the scan hardly sees, body frame
  int iterations = 0;
  int points = 0;   // offered
  int matched = 0;  // fell on mapped surface
  int inliers = 0;
  double residual_rms_m = 0.0;  // over inliers

  // Whether the unobservable direction nearest to each map axis (x, y, yaw) exists.
  std::array<bool, 3> UnobservableAxes() const;
  double InlierRatio() const { return points > 0 ? static_cast<double>(inliers) / points : 0.0; }
};

// The most probable pose and velocity, given the prediction and a scan in a signed distance map phi:
//   argmin |e|^2_{P^-1} + k sum_i w_i rho(phi(T Exp(v dt_i) p_i)),
//   1 / w_i = sigma_i^2 cos(incidence_i)^2 + sigma_map^2 + n_i sigma_shared^2,
// n_i the beams that share an error with beam i, k the independence of the rest: an iterated Kalman update by
// Gauss-Newton on SE(2) x R^3 with Levenberg-Marquardt damping and Huber's rho (in sigmas of the beam alone). The scan
// is deskewed once, with the predicted velocity v (sudden_motion.h says what is done where v was wrong), and moves the
// velocity only through the prediction's covariance P: a velocity estimated from the distortion within the scan takes
// errors of the map, which its beams share, for motion. Along directions that the scan does not determine the
// prediction's covariance decides: they stay where it put them, and the little that a scan does say of them counts for
// no more than it is worth. Pure.
[[nodiscard]] AlignResult Align(const SdfMap& map, std::span<const ScanPoint> points,
                                const Eigen::Vector2d& origin_body, const NoiseModel& noise,
                                const MotionState& prediction, const RegistrationOptions& options);

}  // namespace lcmslam::sdf2d
