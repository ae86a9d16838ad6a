#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lcmslam {

// One beam of a planar lidar, in the lidar's frame (x forward, y left).
struct Beam {
  float range_m = 0.0F;    // no return when not finite or <= 0
  float angle_rad = 0.0F;  // counter-clockwise from x
  int32_t dt_us = 0;       // time of the beam minus the scan's utime; <= 0, 0 when unknown

  bool HasReturn() const { return std::isfinite(range_m) && range_m > 0.0F; }
};

// One turn of a planar lidar, beams in the order the sensor gave them.
struct PlanarScan {
  int64_t utime = 0;  // us; time of the last beam
  std::vector<Beam> beams;
};

}  // namespace lcmslam
