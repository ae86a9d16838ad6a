#include <fmt/format.h>
#include <lcmslam/lidar_packet_t.hpp>

#include "bus/lcm_log.h"
#include "bus/log_reader.h"
#include "bus/signals.h"
#include "geometry/utime.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"
#include "sensor-bridge/velodyne_bridge.h"
#include "sensors/bad_input.h"
#include "sensors/velodyne_payloads.h"
#include "sensors/velodyne_reader.h"

namespace lcmslam {
namespace {

bool IsPacket(Bytes message) { return Fingerprint(message) == lidar_packet_t::getHash(); }

void ImportLcmLog(const VelodyneImportOptions& options, SensorPublisher& publisher, VelodyneBridge& bridge) {
  LogReader reader(options.file);
  for (Event event; !StopRequested() && reader.Next(event);) {
    if (event.channel == kMultiLineChannel) continue;  // comes anew
    if (!IsPacket(event.data)) {
      publisher.PublishAsIs(event.channel, event.utime, std::move(event.data));
      continue;
    }
    const auto packet = Decode<lidar_packet_t>(event.data);
    if (!packet || !IsReasonableUtime(packet->utime))
      throw BadInput(fmt::format("{}: malformed message on {} before offset {}", options.file.string(), event.channel,
                                 reader.position_bytes()));
    const auto port = static_cast<uint16_t>(packet->port);
    if (options.port == 0 || port == options.port) bridge.Add(packet->payload, packet->utime, port);
  }
  if (!reader.DamageReport().empty()) throw BadInput(reader.DamageReport());
}

int64_t CountSweeps(const VelodyneImportOptions& options) {
  int64_t sweeps = 0;
  try {
    for (VelodyneReader reader(options.file, options.port); reader.Next();) ++sweeps;
  } catch (const BadInput&) {  // the second pass comes to the same place
  }
  return sweeps;
}

void ImportPayloads(const VelodyneImportOptions& options, VelodyneBridge& bridge) {
  VelodynePayloadReader reader(options.file, options.port);
  while (const std::optional<VelodynePayload> payload = StopRequested() ? std::nullopt : reader.Next()) {
    bridge.Add(payload->bytes, payload->received_utime, payload->port);
  }
}

std::string WhyNoSweep(const VelodyneImportOptions& options, const VelodyneBridge& bridge) {
  if (bridge.packets() > 0) return fmt::format("no whole turn of a VLP-16 or HDL-32E; {}", bridge.Summary());
  return fmt::format("no packet of a VLP-16 or HDL-32E{}",
                     options.port == 0 ? "" : fmt::format(" to port {}", options.port));
}

}  // namespace

void ImportVelodyne(const VelodyneImportOptions& options, SensorPublisher& publisher, const Note& note) {
  VelodyneBridge bridge(publisher, options.keep_packets);
  if (BeginsAsLcmLog(options.file)) {
    ImportLcmLog(options, publisher, bridge);
  } else {
    publisher.ExpectScans(CountSweeps(options));
    ImportPayloads(options, bridge);
  }
  note(bridge.Summary());
  if (bridge.sweeps() == 0 && !StopRequested())
    throw BadInput(fmt::format("{}: {}", options.file.string(), WhyNoSweep(options, bridge)));
}

}  // namespace lcmslam
