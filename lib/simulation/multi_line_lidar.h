#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"
#include "lidar/multi_line_model.h"
#include "lidar/sweep.h"
#include "simulation/spatial_motion.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

struct MultiLineLidarOptions {
  MultiLineModel model = VelodyneVlp16();
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
