#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "simulation/planar_motion.h"

namespace lcmslam {

// Odometry drifts: a scale error that is drawn once, and a random walk that grows with the way.
struct PlanarOdometryOptions {
  double rate_hz = 0.0;                          // 0: no odometry
  double translation_scale_sigma = 0.01;         // 1 = 100 %
  double rotation_scale_sigma = 0.01;            // 1 = 100 %
  double translation_walk_m_per_sqrt_m = 0.01;   // of each axis
  double rotation_walk_rad_per_sqrt_m = 0.005;   // per way driven
  double rotation_walk_rad_per_sqrt_rad = 0.01;  // per angle turned

  std::string Validate() const;
};

struct OdometrySample {
  int64_t utime = 0;                                     // us
  Pose2 T_odom_body = {};                                // the frame odom is the first body pose
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s; over the interval that ends at utime
};

// What the wheels say of the motion, from its start to its end. Deterministic in the seed.
[[nodiscard]] std::vector<OdometrySample> SimulateOdometry(const PlanarMotion& motion,
                                                           const PlanarOdometryOptions& options, uint64_t seed);

}  // namespace lcmslam
