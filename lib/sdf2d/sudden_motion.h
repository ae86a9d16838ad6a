#pragma once

#include <span>

#include <Eigen/Core>

#include "sdf2d/registration.h"

namespace lcmslam::sdf2d {

// Registration of a scan within which the body did not go on as predicted, so that the predicted velocity skews it.
// The prediction of all three has gone on for dt_s (> 0) at its velocity. Pure.

// How far the predicted velocity turns the scan out of its shape if T_map_body is right, rad, never negative; 0 where
// dt_s is.
[[nodiscard]] double Skew_rad(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s,
                              const Pose2& T_map_body);

// Registers again, deskewed with the mean velocity that leads to the pose of `align`, and so on while no fewer points
// fit. Each round halves what is wrong with the velocity, or better.
[[nodiscard]] AlignResult AlignDeskewedAgain(const SdfMap& map, std::span<const ScanPoint> points,
                                             const Eigen::Vector2d& origin_body, const NoiseModel& noise,
                                             const MotionState& prediction, double dt_s, const AlignResult& align,
                                             const RegistrationOptions& options);

// For a body that begins to turn on the spot from one scan to the next, or stops to: registers coarse to fine, deskewed
// for turn rates up to max_turn_rate (rad/s) either way; the one with most inliers, deskewed again.
[[nodiscard]] AlignResult AlignTurning(const SdfMap& map, const SdfMap& coarse_map, std::span<const ScanPoint> points,
                                       const Eigen::Vector2d& origin_body, const NoiseModel& noise,
                                       const MotionState& prediction, double dt_s, double max_turn_rate,
                                       const RegistrationOptions& options);

}  // namespace lcmslam::sdf2d
