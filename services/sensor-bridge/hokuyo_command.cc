#include "sensor-bridge/hokuyo_command.h"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bus/clock.h"
#include "bus/signals.h"
#include "sensor-bridge/bridge_output.h"
#include "sensor-bridge/byte_link.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/sensor_publisher.h"
#include "sensors/bad_input.h"
#include "sensors/scip.h"

namespace lcmslam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookForSignals(100);
constexpr std::chrono::seconds kPatience(3);

struct HokuyoOptions {
  std::string host;
  std::string device;
  uint16_t port = 10940;
  OutputOptions output;
};

// A sensor that speaks SCIP 2.
class ScipSensor {
 public:
  explicit ScipSensor(ByteLink link) : link_(std::move(link)) {}

  // Sends the command and takes its answer. Throws CommandError (kRuntime) when none comes.
  ScipReply Ask(const std::string& command) {
    link_.Send(command);
    const auto deadline = Clock::now() + kPatience;
    while (Clock::now() < deadline && !StopRequested()) {
      const std::optional<ScipReply> reply = Next();
      if (reply && reply->command + "\n" == command) return *reply;
    }
    throw CommandError(ExitCode::kRuntime, fmt::format("no answer to {}", command.substr(0, 2)));
  }
  void Send(const std::string& command) { link_.Send(command); }
  // None when nothing comes for a moment.
  std::optional<ScipReply> Next() {
    if (std::optional<ScipReply> reply = reader_.Next()) return reply;
    reader_.Append(link_.Receive(kLookForSignals));
    return reader_.Next();
  }

 private:
  ByteLink link_;
  ScipReplyReader reader_;
};

void PublishScans(ScipSensor& sensor, const ScipParameters& parameters, BridgeOutput& output,
                  SensorPublisher& publisher) {
  const ScipReply begun = sensor.Ask(ScipScanCommand(parameters));
  if (begun.status != "00") throw CommandError(ExitCode::kRuntime, "no scans: status " + begun.status);
  while (!StopRequested()) {
    output.Idle();
    const std::optional<ScipReply> reply = sensor.Next();
    if (!reply || !reply->command.starts_with("MD")) continue;
    if (reply->status != "99") throw CommandError(ExitCode::kRuntime, "scans end with status " + reply->status);
    const PlanarScan scan = DecodeScipScan(*reply, parameters, WallClockUtime());
    output.health().BeginEvent(scan.utime, scan.utime);
    output.health().NoteInput(kMainLidarChannel, scan.utime);
    publisher.PublishScan(kMainLidarChannel, scan);
    publisher.Flush();
  }
}

ExitCode HearHokuyo(const HokuyoOptions& options) {
  if (options.host.empty() == options.device.empty())
    throw CommandError(ExitCode::kUsage, "--host, --device: one of them is needed");
  CatchStopSignals();
  ScipSensor sensor(options.device.empty() ? ByteLink::Tcp(options.host, options.port)
                                           : ByteLink::Serial(options.device));
  BridgeOutput output(options.output);
  SensorPublisher publisher(output, options.output.quiet);
  try {
    sensor.Send("SCIP2.0\n");  // an URG-04LX may start with SCIP 1; others do not mind
    sensor.Ask(kScipStop);
    const ScipParameters parameters = ParseScipParameters(sensor.Ask("PP\n"));
    sensor.Ask("BM\n");
    fmt::print(stderr, "READY\n");
    PublishScans(sensor, parameters, output, publisher);
    sensor.Send(kScipStop);
  } catch (const BadInput& error) {
    throw CommandError(ExitCode::kBadInput, error.what());
  }
  output.Finish();
  if (!options.output.quiet) fmt::print(stderr, "sensor-bridge: {}\n", publisher.Summary());
  return ExitCode::kOk;
}

}  // namespace

void AddHokuyoCommand(CLI::App& app, std::function<ExitCode()>& command) {
  auto options = std::make_shared<HokuyoOptions>();
  options->output.speed = 0.0;  // the sensor sets the pace
  CLI::App* hokuyo = app.add_subcommand("hokuyo", "Hear a Hokuyo with SCIP 2 over TCP or a serial line");
  hokuyo->add_option("--host", options->host, "name or address of a sensor with Ethernet");
  hokuyo->add_option("--port", options->port, "its TCP port")->capture_default_str();
  hokuyo->add_option("--device", options->device, "of a sensor with USB, as /dev/ttyACM0");
  AddOutputOptions(*hokuyo, options->output);
  hokuyo->callback([options, &command] { command = [options] { return HearHokuyo(*options); }; });
}

}  // namespace lcmslam
