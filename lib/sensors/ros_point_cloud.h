#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lidar/sweep.h"
#include "sensors/point_table.h"

namespace lcmslam {

// sensor_msgs/PointCloud2.
struct RosPointCloud {
  int64_t utime = 0;  // us, of the header
  std::string frame;
  PointTable table;  // fields of one number each; others are passed over
};

// Throws BadInput when the bytes are not what their counts say. Pure.
[[nodiscard]] RosPointCloud DecodeRosPointCloud(std::span<const uint8_t> data);

// Stamped with the last point and in the order of time; what is no return is left out. Times of points count from the
// header's stamp or from 1970. Where there are none, or they are of another clock, the header's stamp is taken as the
// last point's. Throws BadInput as ToSweepPoints does. Pure.
[[nodiscard]] Sweep ToSweep(const RosPointCloud& cloud);

}  // namespace lcmslam
