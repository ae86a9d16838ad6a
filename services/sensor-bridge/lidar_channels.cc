#include "sensor-bridge/lidar_channels.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

constexpr size_t kMaxNameCharacters = 40;  // LCM's 63 for a channel, less LIDAR_2D_ and _EXTRINSICS

std::string ChannelName(const std::string& lidar) {
  std::string name;
  for (const unsigned char c : lidar) {
    const bool plain = std::isalnum(c) != 0;
    if (plain || !name.empty()) name.push_back(plain ? static_cast<char>(std::toupper(c)) : '_');
  }
  if (name.size() > kMaxNameCharacters) name.erase(0, name.size() - kMaxNameCharacters);
  return fmt::format("{}_{}", kMainLidarChannel, name);
}

}  // namespace

std::map<std::string, std::string> LidarChannels(const std::map<std::string, int64_t>& scans_by_lidar,
                                                 const std::string& chosen, const std::string& why_none) {
  if (scans_by_lidar.empty()) throw CommandError(ExitCode::kBadInput, why_none);
  auto main = std::ranges::max_element(scans_by_lidar, {}, [](const auto& lidar) { return lidar.second; });
  if (!chosen.empty()) {
    main = scans_by_lidar.find(chosen);
    if (main == scans_by_lidar.end()) {
      std::vector<std::string> names;
      for (const auto& [lidar, scans] : scans_by_lidar) names.push_back(lidar);
      throw CommandError(ExitCode::kUsage,
                         fmt::format("no scans from '{}'; there are {}", chosen, fmt::join(names, ", ")));
    }
  }
  std::map<std::string, std::string> channels;
  for (const auto& [lidar, scans] : scans_by_lidar)
    channels[lidar] = lidar == main->first ? kMainLidarChannel : ChannelName(lidar);
  return channels;
}

int64_t TotalScans(const std::map<std::string, int64_t>& scans_by_lidar) {
  int64_t total = 0;
  for (const auto& [lidar, scans] : scans_by_lidar) total += scans;
  return total;
}

}  // namespace lcmslam
