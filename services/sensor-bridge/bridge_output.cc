#include "sensor-bridge/bridge_output.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <CLI/CLI.hpp>
#include <lcmslam/service_status_t.hpp>

#include "bus/clock.h"
#include "bus/signals.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kJumpUs = 10'000'000;  // a step of the data's clock that nobody wants to wait for
constexpr std::chrono::milliseconds kNap(50);

// What default kernel buffers (208 kB) take without loss while a receiver is kept waiting for a few milliseconds: of a
// sweep sent in one go, most is lost.
constexpr double kReceiverBytesPerSecond = 40e6;
constexpr std::chrono::milliseconds kReceiverBacklog(2);

}  // namespace

std::string OutputOptions::Validate() const {
  if (!std::isfinite(speed) || speed < 0.0) return "--speed: must be 0 or more";
  return "";
}

void AddOutputOptions(CLI::App& app, OutputOptions& options) {
  auto* log_out = app.add_option("--log-out", options.log_out, "write this LCM log instead of publishing live");
  app.add_option("--lcm-url", options.lcm_url, "bus; default $LCM_DEFAULT_URL, else udpm with ttl=0")
      ->excludes(log_out);
  app.add_flag("--quiet", options.quiet, "no progress bar, no notes, no summary");
}

void AddPacedOutputOptions(CLI::App& app, OutputOptions& options) {
  AddOutputOptions(app, options);
  app.add_option("--speed", options.speed, "live: data seconds per second, 0: as fast as it goes")
      ->excludes(app.get_option("--log-out"))
      ->capture_default_str();
}

BridgeOutput::BridgeOutput(const OutputOptions& options)
    : options_(options), health_("sensor-bridge"), next_status_(Clock::now()) {
  if (options.log_out.empty()) {
    bus_.emplace(options.lcm_url);
  } else {
    log_.emplace(options.log_out);
  }
}

void BridgeOutput::Publish(int64_t utime, const std::string& channel, Bytes data) {
  if (log_) {
    log_->Write(utime, channel, data);
    return;
  }
  WaitFor(utime);
  WaitForReceivers(data.size());
  bus_->Publish(channel, data);
  health_.CountReceived();
  health_.CountProcessed();
  const int64_t now_utime = WallClockUtime();
  health_.BeginEvent(now_utime, now_utime);
  health_.NoteStamp(utime);
  PublishStatusOnceASecond();
}

void BridgeOutput::Idle() {
  if (bus_) PublishStatusOnceASecond();
}

void BridgeOutput::Finish() {
  if (log_) log_->Flush();
}

void BridgeOutput::WaitFor(int64_t utime) {
  const int64_t step_us = UtimeDifference(utime, last_utime_);
  if (!started_ || std::abs(step_us) > kJumpUs || options_.speed == 0.0) {
    origin_ = Clock::now();
    origin_utime_ = utime;
  }
  started_ = true;
  last_utime_ = utime;
  if (options_.speed == 0.0) return;
  const double wait_us = static_cast<double>(UtimeDifference(utime, origin_utime_)) / options_.speed;
  const auto due = origin_ + std::chrono::microseconds(std::llround(wait_us));
  while (!StopRequested()) {
    const auto now = Clock::now();
    if (now >= due) return;
    PublishStatusOnceASecond();
    std::this_thread::sleep_for(std::min<Clock::duration>(due - now, kNap));
  }
}

void BridgeOutput::WaitForReceivers(size_t bytes) {
  std::this_thread::sleep_until(received_ - kReceiverBacklog);
  const auto duration = std::chrono::duration<double>(static_cast<double>(bytes) / kReceiverBytesPerSecond);
  received_ = std::max(received_, Clock::now()) + std::chrono::duration_cast<Clock::duration>(duration);
}

void BridgeOutput::PublishStatusOnceASecond() {
  const auto now = Clock::now();
  if (now < next_status_) return;
  next_status_ = now + std::chrono::seconds(1);
  bus_->Publish("SENSOR_BRIDGE_STATUS", Encode(health_.Report(WallClockUtime(), true)));
}

}  // namespace lcmslam
