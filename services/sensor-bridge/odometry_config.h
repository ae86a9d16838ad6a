#pragma once

#include "common/config.h"
#include "simulation/odometry_drift.h"

namespace lcmslam {

// Ties config::Episode::Odometry to its options.
inline void BindOdometry(ConfigBinder bind, OdometryOptions& odometry) {
  bind("rate_hz", odometry.rate_hz)("translation_scale_sigma", odometry.translation_scale_sigma);
  bind("rotation_scale_sigma", odometry.rotation_scale_sigma);
  bind("translation_walk_m_per_sqrt_m", odometry.translation_walk_m_per_sqrt_m);
  bind("rotation_walk_rad_per_sqrt_m", odometry.rotation_walk_rad_per_sqrt_m);
  bind("rotation_walk_rad_per_sqrt_rad", odometry.rotation_walk_rad_per_sqrt_rad);
}

}  // namespace lcmslam
