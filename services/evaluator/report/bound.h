#pragma once

#include <filesystem>
#include <limits>

namespace lcmslam::report {

// The Cramer-Rao bound of single scans' position, over the scans of an episode that fix the pose. NaN where unknown.
struct Bound {
  double mean_m = std::numeric_limits<double>::quiet_NaN();
  double rms_m = std::numeric_limits<double>::quiet_NaN();
};

// Column position_m of the CSV file that `sensor-bridge simulate --bound` writes. Throws CommandError (kBadInput) for a
// file without that column and for lines that hold no number; inf is a scan that does not fix the pose.
Bound ReadBound(const std::filesystem::path& path);

}  // namespace lcmslam::report
