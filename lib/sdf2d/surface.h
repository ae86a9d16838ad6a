#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "sdf2d/noise_model.h"
#include "sdf2d/options.h"

namespace lcmslam::sdf2d {

// A straight piece of surface seen by consecutive beams. Body frame at scan end.
struct SurfaceLine {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // unit length, towards the lidar
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();    // m; on the line, where its first and last beam meet it
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  // Variance of the line's position along its normal at t metres from `begin`: v[0] + v[1] t + v[2] t^2 (m^2).
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  double beam_sigma_m = 0.0;  // of one beam, across the line
  int num_beams = 0;
};

// Splits a scan into straight pieces. From one place, a wall n.p = d is linear in inverse ranges,
//   1/r = m.u(angle), m = n/d,
// with noise that the range noise tells and angles that have none: unlike total least squares on points, this does not
// tilt walls towards the beam when noise is large. A run of beams is cut where two lines explain it better than one by
// split_chi2, and the pieces are fitted once more with the noise linearized on the fitted line (maximum likelihood).
// p_body: end points in beam order, deskewed; finite. Pieces too short or too oblique to be trusted are left out. Pure.
[[nodiscard]] std::vector<SurfaceLine> ExtractSurface(std::span<const Eigen::Vector2d> p_body,
                                                      const Eigen::Vector2d& origin_body, const NoiseModel& noise,
                                                      const SurfaceOptions& options);

}  // namespace lcmslam::sdf2d
