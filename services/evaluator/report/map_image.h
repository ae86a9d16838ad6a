#pragma once

#include <filesystem>
#include <string>

namespace lcmslam::report {

// A map as drawn by a SLAM system (8-bit binary PGM and, beside it, its YAML), cut to what is known.
struct MapImage {
  std::string png;  // "" when the file is no such map
  int width = 0, height = 0;
  double resolution_m = 0.0;  // of a pixel; 0: unknown
};
// Throws CommandError (kBadInput) when the file cannot be read.
MapImage LoadMapImage(const std::filesystem::path& pgm);

}  // namespace lcmslam::report
