#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"
#include "lidar/sweep.h"
#include "simulation/spatial_motion.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

// One laser of the spinning head.
struct Laser {
  double elevation_rad = 0.0;
  double azimuth_rad = 0.0;    // in the head, counter-clockwise
  double fire_delay_us = 0.0;  // after the start of the firing cycle
  int16_t ring = 0;            // 0 lowest
};

// A head of lasers that turns clockwise (seen from above) at constant speed and fires them in a fixed cycle. All beams
// leave from one point: the lateral offsets of the real diodes are left out.
struct MultiLineLidarModel {
  std::vector<Laser> lasers = {};  // in firing order
  double firing_cycle_us = 0.0;
  double turn_s = 0.1;  // so also between sweeps; a turn need not hold a whole number of cycles
  double min_range_m = 0.0;
  double max_range_m = 0.0;  // on a surface of full reflectivity met at a right angle

  std::string Validate() const;
};

MultiLineLidarModel VelodyneVlp16();   // 16 lasers, 2 degrees apart, about 28,900 shots a turn
MultiLineLidarModel VelodyneHdl32e();  // 32 lasers, 1.33 degrees apart, -30.67..10.67, about 69,400 shots a turn
MultiLineLidarModel VelodyneHdl64e();  // 64 lasers, -24.33..2 degrees, about 133,000 shots a turn
MultiLineLidarModel OusterOs1_64();    // 64 lasers, -16.6..16.6 degrees, 1024 columns, 65,536 shots a turn

// By name: vlp16, hdl32e, hdl64e, os1-64. Throws std::invalid_argument on another.
MultiLineLidarModel MultiLineLidarByName(std::string_view name);

struct MultiLineLidarOptions {
  MultiLineLidarModel model = VelodyneVlp16();
  double range_sigma_m = 0.03;       // Gaussian, along the beam
  double dropout_probability = 0.0;  // of a return that would have been seen
  Pose3 T_body_lidar = {};
  bool motion_distortion =
      true;  // each point from the pose at its own time; off: all from the pose at the sweep's utime

  std::string Validate() const;
};

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// A simulated sweep and how well it could be placed in the true map.
struct SimulatedSweep {
  Sweep sweep;  // dt_us is 0 without motion distortion
  // The Cramer-Rao bound of the body pose (x, y, z, rotation vector; world axes, about the body's origin) at
  // sweep.utime, given the map and the motion within the sweep. Zero without noise; none where the sweep does not fix
  // the pose.
  std::optional<Matrix6d> bound;
};

// Turn `index` (0 is the first) of a lidar that started to turn and fire at motion time 0; the sweep's utime is the
// time of the last shot, in us of motion time. A surface sends light back as reflectivity * cos(incidence) / range^2:
// a hit whose signal is below that of max_range_m, or closer than min_range_m, gives no point. Intensity is
// 255 * reflectivity * cos(incidence). Pure: the noise depends on seed and index only.
[[nodiscard]] SimulatedSweep SimulateSweep(const SpatialWorld& world, const SpatialMotion& motion, int index,
                                           const MultiLineLidarOptions& options, uint64_t seed);

}  // namespace lcmslam
