#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>
#include <boost/random/normal_distribution.hpp>

#include "simulation/random.h"

namespace lcmslam {

// Odometry drifts: a scale error that is drawn once, and a random walk that grows with the way.
struct OdometryOptions {
  double rate_hz = 0.0;                          // 0: no odometry
  double translation_scale_sigma = 0.01;         // 1 = 100 %
  double rotation_scale_sigma = 0.01;            // 1 = 100 %
  double translation_walk_m_per_sqrt_m = 0.01;   // of each axis
  double rotation_walk_rad_per_sqrt_m = 0.005;   // per way travelled, of each axis
  double rotation_walk_rad_per_sqrt_rad = 0.01;  // per angle turned, of each axis

  std::string Validate() const;
};

// What odometry makes of the true motion, step by step. Deterministic in the seed.
class OdometryDrift {
 public:
  // `options` must outlive it.
  OdometryDrift(const OdometryOptions& options, uint64_t seed);

  // One step in the body's frame: metres, then radians (1 in the plane, a rotation vector in space).
  [[nodiscard]] Eigen::Vector3d MeasurePlanar(const Eigen::Vector3d& moved);
  [[nodiscard]] Eigen::Matrix<double, 6, 1> MeasureSpatial(const Eigen::Matrix<double, 6, 1>& moved);

 private:
  template <int kAxes, int kAngles>
  Eigen::Matrix<double, kAxes + kAngles, 1> Measure(const Eigen::Matrix<double, kAxes + kAngles, 1>& moved);

  const OdometryOptions& options_;
  Rng rng_;
  boost::random::normal_distribution<double> normal_;
  double translation_scale_;
  double rotation_scale_;
};

}  // namespace lcmslam
