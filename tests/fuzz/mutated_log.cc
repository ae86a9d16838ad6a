// mutated_log OUT.lcm COUNT SEED: writes COUNT mutated messages of every type, each type on every channel that a
// service listens to, and COUNT mutated chunks of sweeps on LIDAR_3D, 1 ms apart.

#include <array>
#include <cstdlib>
#include <random>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "bus/errors.h"
#include "bus/log_writer.h"
#include "bus/wire.h"
#include "support/every_type.h"
#include "support/sample_messages.h"

namespace lcmslam {
namespace {

constexpr std::array kChannels{
    "LIDAR_2D", "LIDAR_2D_EXTRINSICS", "LIDAR_3D",     "LIDAR_3D_EXTRINSICS", "LIDAR_3D_PACKET", "IMU",
    "ODOMETRY", "GROUND_TRUTH",        "SLAM_COMMAND", "SDF2D_POSE"};

template <class... Messages>
void WriteMutated(int count, std::mt19937_64& random, LogWriter& log, std::tuple<Messages...> /*types*/) {
  int64_t log_utime = 1'000'000;
  const auto write = [&](const std::string& channel, std::vector<uint8_t> bytes) {
    log.Write(log_utime += 1000, channel, Mutate(std::move(bytes), random));
  };
  for (int i = 0; i < count; ++i) {
    const std::string channel = kChannels[static_cast<size_t>(i) % kChannels.size()];
    (write(channel, Encode(RandomMessage<Messages>(random))), ...);
    write("LIDAR_3D", Encode(RandomMessage<point_cloud_chunk_t>(random)));
  }
}

}  // namespace
}  // namespace lcmslam

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: mutated_log OUT.lcm COUNT SEED\n");
    return static_cast<int>(lcmslam::ExitCode::kUsage);
  }
  lcmslam::LogWriter log(argv[1]);
  std::mt19937_64 random(std::strtoull(argv[3], nullptr, 10));
  lcmslam::WriteMutated(std::atoi(argv[2]), random, log, lcmslam::EveryType{});
  return 0;
}
