#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lidar/imu_sample.h"
#include "simulation/spatial_motion.h"

namespace lcmslam {

// The usual model of a MEMS unit (as in Kalibr): white noise and a bias that starts off zero and walks,
// in all axes alike.
struct ImuOptions {
  double rate_hz = 0.0;  // 0: no IMU
  double gyroscope_noise_radps_per_sqrt_hz = 2e-4;
  double gyroscope_bias_sigma_radps = 5e-3;  // at the start
  double gyroscope_walk_radps2_per_sqrt_hz = 2e-5;
  double accelerometer_noise_mps2_per_sqrt_hz = 2e-3;
  double accelerometer_bias_sigma_mps2 = 0.05;  // at the start
  double accelerometer_walk_mps3_per_sqrt_hz = 2e-4;

  std::string Validate() const;
};

// What an IMU at the body's origin, in the body's axes, reads at start_utime and every 1 / rate_hz from then on to the
// end of the motion, whose time 0 is start_utime. Deterministic in the seed.
[[nodiscard]] std::vector<ImuSample> SimulateImu(const SpatialMotion& motion, int64_t start_utime,
                                                 const ImuOptions& options, uint64_t seed);

}  // namespace lcmslam
