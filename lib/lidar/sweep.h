#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lcmslam {

// One return of a multi-line lidar, in the lidar's frame at the time of the point (x forward, y left, z up).
struct SweepPoint {
  float x = 0.0F;  // m; no return when x, y or z is not finite
  float y = 0.0F;
  float z = 0.0F;
  float intensity = 0.0F;  // as the sensor gives it
  int16_t ring = -1;       // laser number, 0 lowest; -1 when unknown
  int32_t dt_us = 0;       // time of the point minus the sweep's utime; <= 0, 0 when unknown

  bool IsFinite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(z); }
};

// One turn of a multi-line lidar, points in the order the sensor measured them.
struct Sweep {
  int64_t utime = 0;  // us; time of the last point
  std::vector<SweepPoint> points;
};

}  // namespace lcmslam
