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

std::string ChannelName(const std::string& main_channel, const std::string& sensor) {
  std::string name;
  for (const unsigned char c : sensor) {
    const bool plain = std::isalnum(c) != 0;
    if (plain || !name.empty()) name.push_back(plain ? static_cast<char>(std::toupper(c)) : '_');
  }
  if (name.size() > kMaxNameCharacters) name.erase(0, name.size() - kMaxNameCharacters);
  return fmt::format("{}_{}", main_channel, name);
}

}  // namespace

std::map<std::string, std::string> SensorChannels(const std::map<std::string, int64_t>& messages_by_sensor,
                                                  const std::string& chosen, const std::string& main_channel) {
  auto main = std::ranges::max_element(messages_by_sensor, {}, [](const auto& sensor) { return sensor.second; });
  if (!chosen.empty()) {
    main = messages_by_sensor.find(chosen);
    if (main == messages_by_sensor.end()) {
      std::vector<std::string> names;
      for (const auto& [sensor, messages] : messages_by_sensor) names.push_back(sensor);
      throw CommandError(
          ExitCode::kUsage,
          fmt::format("nothing for {} from '{}'; there {} {}", main_channel, chosen, names.empty() ? "is" : "are",
                      names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    }
  }
  std::map<std::string, std::string> channels;
  for (const auto& [sensor, messages] : messages_by_sensor)
    channels[sensor] = sensor == main->first ? main_channel : ChannelName(main_channel, sensor);
  return channels;
}

std::map<std::string, std::string> LidarChannels(const std::map<std::string, int64_t>& scans_by_lidar,
                                                 const std::string& chosen, const std::string& why_none) {
  if (scans_by_lidar.empty()) throw CommandError(ExitCode::kBadInput, why_none);
  return SensorChannels(scans_by_lidar, chosen, kMainLidarChannel);
}

int64_t TotalScans(const std::map<std::string, int64_t>& scans_by_lidar) {
  int64_t total = 0;
  for (const auto& [lidar, scans] : scans_by_lidar) total += scans;
  return total;
}

}  // namespace lcmslam
