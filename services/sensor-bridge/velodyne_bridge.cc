#include "sensor-bridge/velodyne_bridge.h"

#include <fmt/format.h>

#include "sensor-bridge/lidar_channels.h"

namespace lcmslam {

void VelodyneBridge::Add(std::span<const uint8_t> payload, std::optional<int64_t> received_utime, uint16_t port) {
  const std::vector<Sweep> sweeps = decoder_.Add(payload, received_utime);
  if (keep_packets_)
    publisher_.PublishPacket(kPacketChannel, received_utime.value_or(decoder_.packet_utime()), port, payload);
  for (const Sweep& sweep : sweeps) publisher_.PublishSweep(kMultiLineChannel, sweep);
  sweeps_ += static_cast<int64_t>(sweeps.size());
}

std::string VelodyneBridge::Summary() const {
  return fmt::format("{} packets, {} of them not to be decoded", packets(), refused());
}

}  // namespace lcmslam
