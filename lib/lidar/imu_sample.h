#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace lcmslam {

// One reading of an inertial measurement unit, in its own frame.
struct ImuSample {
  int64_t utime = 0;  // us
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();  // acceleration less gravity: +9.8 upwards at rest
};

}  // namespace lcmslam
