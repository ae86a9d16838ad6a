#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar/sweep.h"

namespace lcmslam {

// The columns of a file of points, by name.
struct PointTable {
  size_t num_points = 0;
  std::map<std::string, std::vector<double>, std::less<>> columns;  // each of num_points numbers

  // An empty column, valid as long as the table; throws BadInput when there is one of that name.
  std::vector<double>& AddColumn(const std::string& name);
};

// Columns x, y, z (m) are needed; taken where they are: intensity (or i, reflectivity), ring (or laser_id), and the
// points' times, of which only the differences count: the latest is the sweep's utime. Points that are non-finite or
// (0, 0, 0), no returns, stay, without time and ring. Throws BadInput when x, y or z is missing, or a ring or the
// spread of the times (over 2000 s) is absurd. Pure.
[[nodiscard]] std::vector<SweepPoint> ToSweepPoints(const PointTable& table);

// The latest of the returns' times, us, after whatever their origin is; none where there are no times or returns. They
// stand in t or offset_time (integer nanoseconds: Ouster, Livox), time (seconds: Velodyne), or timestamp (since 1970,
// in seconds: Hesai, RoboSense; or nanoseconds: Livox). Throws as ToSweepPoints does.
[[nodiscard]] std::optional<double> LatestTime_us(const PointTable& table);

}  // namespace lcmslam
