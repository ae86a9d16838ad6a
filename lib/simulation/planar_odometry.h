#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "simulation/odometry_drift.h"
#include "simulation/planar_motion.h"

namespace lcmslam {

struct OdometrySample {
  int64_t utime = 0;                                     // us
  Pose2 T_odom_body = {};                                // the frame odom is the first body pose
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s; over the interval that ends at utime
};

// What the wheels say of the motion, from its start to its end. Deterministic in the seed.
[[nodiscard]] std::vector<OdometrySample> SimulateOdometry(const PlanarMotion& motion, const OdometryOptions& options,
                                                           uint64_t seed);

}  // namespace lcmslam
