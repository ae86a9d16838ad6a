// log-info LOG: what an LCM log holds, by channel.

#include <algorithm>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/sdf_tile_t.hpp>
#include <lcmslam/service_status_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>
#include <lcmslam/surfel_chunk_t.hpp>

#include "bus/log_reader.h"
#include "common/command_line.h"

namespace lcmslam {
namespace {

struct Channel {
  int64_t messages = 0;
  int64_t bytes = 0;
  int64_t first_utime = 0, last_utime = 0;  // us; log time
  std::set<int64_t> fingerprints;
};

struct Contents {
  std::map<std::string, Channel> channels;
  std::string damage_report;  // "" or one line
  bool is_damaged = false;    // not so when only the last event is cut off
};

template <class... Messages>
std::map<int64_t, std::string> NamesOf() {
  return {{Messages::getHash(), Messages::getTypeName()}...};
}

// Types of other packages with the same fields go by the same name.
std::string TypeName(int64_t fingerprint) {
  static const std::map<int64_t, std::string> names =
      NamesOf<evaluation_t, imu_t, lidar_packet_t, occupancy_grid_t, planar_lidar_t, planar_scan_t, point_cloud_chunk_t,
              pose_t, pose_xyt_t, rigid_transform_t, sdf_tile_t, service_status_t, slam_command_t, slam_diagnostics_t,
              surfel_chunk_t>();
  const auto known = names.find(fingerprint);
  return known != names.end() ? known->second : fmt::format("{:016x}", static_cast<uint64_t>(fingerprint));
}

Contents Read(const std::string& path) {
  LogReader reader(path);
  Contents contents;
  for (Event event; reader.Next(event);) {
    Channel& channel = contents.channels[event.channel];
    if (channel.messages++ == 0) channel.first_utime = event.utime;
    channel.last_utime = event.utime;
    channel.bytes += static_cast<int64_t>(event.data.size());
    channel.fingerprints.insert(Fingerprint(event.data));
  }
  contents.damage_report = reader.DamageReport();
  contents.is_damaged = reader.damaged_bytes() > 0;
  return contents;
}

void Print(const Contents& contents) {
  size_t width = 24;
  for (const auto& [name, channel] : contents.channels) width = std::max(width, name.size());
  fmt::print("{:<{}} {:<20} {:>9} {:>10} {:>9} {:>11}\n", "channel", width, "type", "messages", "seconds", "hertz",
             "mean bytes");
  for (const auto& [name, channel] : contents.channels) {
    const double seconds = static_cast<double>(channel.last_utime - channel.first_utime) * 1e-6;
    const double hertz = seconds > 0.0 ? static_cast<double>(channel.messages - 1) / seconds : 0.0;
    const std::string type = channel.fingerprints.size() == 1 ? TypeName(*channel.fingerprints.begin()) : "(several)";
    fmt::print("{:<{}} {:<20} {:>9} {:>10.1f} {:>9.2f} {:>11}\n", name, width, type, channel.messages, seconds, hertz,
               channel.bytes / channel.messages);
  }
}

// `count`: "" or the channel whose number of messages is wanted.
ExitCode Tell(const std::string& path, const std::string& count) {
  const Contents contents = Read(path);
  if (count.empty()) {
    Print(contents);
  } else {
    const auto channel = contents.channels.find(count);
    fmt::print("{}\n", channel == contents.channels.end() ? 0 : channel->second.messages);
  }
  if (!contents.damage_report.empty()) fmt::print(stderr, "{}\n", contents.damage_report);
  return contents.is_damaged ? ExitCode::kBadInput : ExitCode::kOk;
}

}  // namespace
}  // namespace lcmslam

int main(int argc, char** argv) {
  CLI::App app("What an LCM log holds, by channel", "log-info");
  std::string path, count;
  app.add_option("LOG", path, "LCM log")->required();
  app.add_option("--count", count, "print only the number of messages on this channel");
  return lcmslam::RunCommandLine(app, argc, argv, [&] { return lcmslam::Tell(path, count); });
}
