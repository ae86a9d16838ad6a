#pragma once

#include <map>
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
// points' times: t (integer nanoseconds, as Ouster writes them) or time, timestamp (seconds), of which only the
// differences count: the latest is the sweep's utime. Non-finite coordinates stay. Throws BadInput when x, y or z is
// missing, or a ring or the spread of the times (over an hour) is absurd. Pure.
[[nodiscard]] std::vector<SweepPoint> ToSweepPoints(const PointTable& table);

}  // namespace lcmslam
