#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/trajectory.h"
#include "sensor-bridge/log_import.h"

namespace lcmslam {

// What a folder with a file a sweep holds, and beside it.
struct CloudFolder {
  std::vector<std::filesystem::path> files;  // in the order of their names
  std::vector<int64_t> utimes;               // of each file
  std::vector<Pose3> T_world_body;           // of each file; or empty
  double turn_s = 0.0;                       // how long the points of a sweep were measured; 0: at one time
  int64_t stamp_before_end_us = 0;           // from the stamp of a file to its last point
};

// Looks for the files of the layout; options override. Throws BadInput with the file's name, CommandError (kUsage) when
// an option names a file that is not there.
[[nodiscard]] CloudFolder FindKittiScans(const CloudImportOptions& options, const Note& note);
// `extension`: ".pcd".
[[nodiscard]] CloudFolder FindClouds(const CloudImportOptions& options, const std::string& extension, const Note& note);

}  // namespace lcmslam
