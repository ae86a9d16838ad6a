#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "lidar/planar_scan.h"
#include "simulation/planar_people.h"
#include "simulation/planar_world.h"
#include "simulation/random.h"

namespace lcmslam {

// A planar lidar turns at constant speed and measures at constant angular steps; it is blind outside its sector.
struct PlanarLidarModel {
  double first_angle_rad = 0.0;  // of the first beam, counter-clockwise from x
  double angle_step_rad = 0.0;   // to the next beam; negative: the lidar turns clockwise
  int num_beams = 0;
  double turn_s = 0.1;  // for 360 degrees, and so between scans
  double min_range_m = 0.0;
  double max_range_m = 0.0;

  double beam_interval_s() const;
  double sweep_s() const;  // from the first beam to the last
  std::string Validate() const;
};

PlanarLidarModel HokuyoUrg04LxUg01();  // 667 beams over 240 degrees, 10 Hz, 0.02-5.6 m
PlanarLidarModel HokuyoUtm30Lx();      // 1081 beams over 270 degrees, 40 Hz, 0.1-30 m
PlanarLidarModel RplidarA1();          // 1454 beams over 360 degrees (8000 a second, clockwise), 5.5 Hz, 0.15-12 m
PlanarLidarModel RplidarA2();          // 800 beams over 360 degrees (8000 a second, clockwise), 10 Hz, 0.15-12 m

// Gaussian noise along the beam, sigma = max(sigma_m, relative_sigma * range).
struct RangeNoise {
  double sigma_m = 0.0;
  double relative_sigma = 0.0;

  double Sigma(double range_m) const { return std::max(sigma_m, relative_sigma * range_m); }
  bool IsNone() const { return sigma_m == 0.0 && relative_sigma == 0.0; }
  std::string Validate() const;

  static RangeNoise None() { return {}; }
  static RangeNoise Low() { return {.sigma_m = 0.01}; }
  static RangeNoise Rated() { return {.sigma_m = 0.03, .relative_sigma = 0.03}; }  // of the URG-04LX-UG01
};

struct PlanarLidarOptions {
  PlanarLidarModel model = HokuyoUrg04LxUg01();
  RangeNoise noise = {};
  Pose2 T_body_lidar = {};
  bool motion_distortion = true;  // each beam from the pose at its own time; off: all from the pose at the scan's utime

  std::string Validate() const;
};

// A simulated scan and how well it could be placed in the true map.
struct SimulatedScan {
  PlanarScan scan;  // beams without return have range 0; dt_us is 0 without motion distortion
  // The Cramer-Rao bound of the body pose (x, y, yaw; world axes, about the body's origin) at scan.utime, given the map
  // and the motion within the scan: inv(sum J^T J / sigma^2), J the derivative of a range by the pose. Zero without
  // noise; none where the scan does not fix the pose.
  std::optional<Eigen::Matrix3d> bound;
};

// The root mean square position error that goes with a pose covariance.
inline double PositionBound(const Eigen::Matrix3d& covariance) {
  return std::sqrt(covariance(0, 0) + covariance(1, 1));
}

// T_world_body by time, us.
using PoseAtTime = std::function<Pose2(int64_t utime)>;

// One turn whose last beam is measured at `utime`. Draws one normal number per beam that meets something in range.
// Beams that end on people tell nothing of the pose, so they have no part in the bound.
[[nodiscard]] SimulatedScan SimulateScan(const PlanarWorld& world, std::span<const Person> people,
                                         const PoseAtTime& T_world_body, int64_t utime,
                                         const PlanarLidarOptions& options, Rng& rng);

}  // namespace lcmslam
