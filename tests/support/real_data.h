#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace lcmslam {

// A real log: under $LCMSLAM_DATA, else in ../shared/data beside the source tree. Tests skip where it does not exist.
inline std::filesystem::path RealData(const std::string& name) {
  const char* folder = std::getenv("LCMSLAM_DATA");
  const std::filesystem::path beside = std::filesystem::path(LCMSLAM_SOURCE_DIR) / ".." / "shared" / "data";
  return (folder != nullptr ? std::filesystem::path(folder) : beside) / name;
}

}  // namespace lcmslam
