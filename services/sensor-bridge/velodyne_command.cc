#include "sensor-bridge/velodyne_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bus/clock.h"
#include "bus/health.h"
#include "bus/signals.h"
#include "bus/udp_receiver.h"
#include "geometry/utime.h"
#include "sensor-bridge/bridge_output.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/sensor_publisher.h"
#include "sensor-bridge/velodyne_bridge.h"
#include "sensors/velodyne_packet.h"

namespace lcmslam {
namespace {

constexpr std::chrono::milliseconds kLookForSignals(100);
constexpr int kBufferBytes = 4 << 20;

struct VelodyneOptions {
  uint16_t port = 2368;
  bool keep_packets = false;
  OutputOptions output;
};

// Hands the packet on and notes for the status whether packets before it are missing, and how late it is.
void Take(const ReceivedDatagram& packet, uint16_t port, VelodyneBridge& bridge, Health& health) {
  const int64_t begin_utime = WallClockUtime(), refused = bridge.refused();
  bridge.Add(packet.payload, packet.received_utime, port);
  if (bridge.refused() > refused) return health.CountRefused();
  health.BeginEvent(packet.received_utime, begin_utime);
  health.NoteInput(kPacketChannel, bridge.packet_utime());
  const int64_t end_utime = WallClockUtime();
  health.NoteLatency(1e-3 * static_cast<double>(UtimeDifference(end_utime, packet.received_utime)),
                     1e-3 * static_cast<double>(UtimeDifference(end_utime, begin_utime)));
}

ExitCode HearVelodyne(const VelodyneOptions& options) {
  CatchStopSignals();
  UdpReceiver receiver({.number = options.port, .buffer_bytes = kBufferBytes});
  BridgeOutput output(options.output);
  SensorPublisher publisher(output, options.output.quiet);
  VelodyneBridge bridge(publisher, options.keep_packets);
  if (!options.output.quiet) fmt::print(stderr, "sensor-bridge: hears UDP port {}\n", receiver.port());
  fmt::print(stderr, "READY\n");
  while (!StopRequested()) {
    output.Idle();
    const std::optional<ReceivedDatagram> datagram = receiver.Receive(kLookForSignals);
    if (!datagram || datagram->payload.size() != kVelodynePacketBytes) continue;  // position packets, say
    Take(*datagram, receiver.port(), bridge, output.health());
    publisher.Flush();
  }
  output.Finish();
  if (!options.output.quiet) fmt::print(stderr, "sensor-bridge: {}; {}\n", bridge.Summary(), publisher.Summary());
  return ExitCode::kOk;
}

}  // namespace

void AddVelodyneCommand(CLI::App& app, std::function<ExitCode()>& command) {
  auto options = std::make_shared<VelodyneOptions>();
  options->output.speed = 0.0;  // the sensor sets the pace
  CLI::App* velodyne = app.add_subcommand("velodyne", "Hear a VLP-16 or HDL-32E over UDP");
  velodyne->add_option("--port", options->port, "UDP port that the sensor sends to; 0: a free one")
      ->capture_default_str();
  velodyne->add_flag("--packets", options->keep_packets, "the payloads go to LIDAR_3D_PACKET as well");
  AddOutputOptions(*velodyne, options->output);
  velodyne->callback([options, &command] { command = [options] { return HearVelodyne(*options); }; });
}

}  // namespace lcmslam
