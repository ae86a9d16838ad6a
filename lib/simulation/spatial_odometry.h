#pragma once

#include <cstdint>

#include "geometry/trajectory.h"
#include "simulation/odometry_drift.h"
#include "simulation/spatial_motion.h"

namespace lcmslam {

// What odometry in space, say of a camera, tells of the motion from its start, which is start_utime, to its end:
// T_odom_body, odom being the first body pose. Empty without a rate. Deterministic in the seed.
[[nodiscard]] Trajectory SimulateSpatialOdometry(const SpatialMotion& motion, int64_t start_utime,
                                                 const OdometryOptions& options, uint64_t seed);

}  // namespace lcmslam
