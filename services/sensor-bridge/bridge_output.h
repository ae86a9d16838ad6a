#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bus/health.h"
#include "bus/live_bus.h"
#include "bus/log_writer.h"
#include "bus/wire.h"

namespace CLI {
class App;
}

namespace lcmslam {

struct OutputOptions {
  std::filesystem::path log_out;  // set: write this log; else publish live
  std::string lcm_url;            // "": $LCM_DEFAULT_URL, else udpm with ttl 0
  double speed = 1.0;             // live: data seconds per second of the clock; 0: as fast as it goes
  bool quiet = false;             // no progress bar, no notes, no summary

  std::string Validate() const;
};
// --log-out, --lcm-url, --quiet.
void AddOutputOptions(CLI::App& app, OutputOptions& options);
// The same and --speed, for what can be played at any pace.
void AddPacedOutputOptions(CLI::App& app, OutputOptions& options);

// Where the bridge's messages go: an LCM log, each event stamped with its message's time; or a live bus, at the pace of
// the messages' times but never faster than receivers can take it, with a service_status_t once a second. Once SIGTERM
// or SIGINT came, nothing waits any more. Throws CommandError as LogWriter and LiveBus do. One thread.
class BridgeOutput {
 public:
  explicit BridgeOutput(const OutputOptions& options);

  void Publish(int64_t utime, const std::string& channel, Bytes data);
  template <LcmMessage M>
  void Publish(int64_t utime, const std::string& channel, const M& message) {
    Publish(utime, channel, Bytes(Encode(message)));
  }
  // Nothing to publish at the moment: the status is due all the same.
  void Idle();
  // What its status says of the input; what is published is counted already.
  Health& health() { return health_; }
  // Hands a log to the operating system.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  void WaitFor(int64_t utime);
  void WaitForReceivers(size_t bytes);
  void PublishStatusOnceASecond();

  OutputOptions options_;
  std::optional<LogWriter> log_;
  std::optional<LiveBus> bus_;
  Health health_;
  Clock::time_point next_status_;
  Clock::time_point received_;  // when receivers are done with what was sent, at the least
  // Message time `origin_utime_` is due at `origin_`.
  Clock::time_point origin_;
  int64_t origin_utime_ = 0;
  int64_t last_utime_ = 0;
  bool started_ = false;
};

}  // namespace lcmslam
