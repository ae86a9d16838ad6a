#include "bus/lcm_log.h"

#include <fstream>

namespace lcmslam {

bool BeginsAsLcmLog(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kLcmLogSync.size()> start{};
  return file.read(start.data(), start.size()) && start == kLcmLogSync;
}

}  // namespace lcmslam
