#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bus/errors.h"
#include "bus/health.h"
#include "bus/log_reader.h"
#include "bus/wire.h"

namespace lcmslam {

// What a handler made of an event.
enum class Handled {
  kIgnored,   // not for us
  kAccepted,  // done
  kRefused,   // for us, but malformed
};

// How a service runs; filled by the command line.
struct RunOptions {
  std::string lcm_url;            // "": $LCM_DEFAULT_URL, else udpm with ttl 0
  std::filesystem::path log_in;   // set: log to log
  std::filesystem::path log_out;  // "": what is published in a log-to-log run is dropped
  std::filesystem::path out;      // folder for the service's files; "": none are written
  bool timings = false;           // wall-clock figures also in log-to-log output, whose bytes then differ between runs
  bool quiet = false;             // no progress bar, no summary
  int queue_messages = 1000;      // live: messages that may wait; more are dropped and counted
};

// What a service sees of the world: it subscribes, publishes and keeps its health. The same live and log to log.
// Handlers, ticks and Publish run on one thread.
class ServiceContext {
 public:
  using Handler = std::function<Handled(const Event&)>;
  using Sink = std::function<void(int64_t utime, const std::string& channel, Bytes data)>;

  ServiceContext(std::string name, RunOptions options);

  // `channel_pattern` is a regular expression that the whole channel name has to match, as in lcm_subscribe.
  void Subscribe(const std::string& channel_pattern, Handler handler);
  // Called once a second: of log time in log-to-log runs, of wall-clock time live. `now_utime` is the time of that
  // clock.
  void EverySecond(std::function<void(int64_t now_utime)> handler);

  void Publish(const std::string& channel, Bytes data);
  template <LcmMessage M>
  void Publish(const std::string& channel, const M& message) {
    Publish(channel, Bytes(Encode(message)));
  }

  Health& health() { return health_; }
  const RunOptions& options() const { return options_; }
  // Whether messages may carry wall-clock figures (see RunOptions::timings).
  bool wall_clock() const { return options_.log_in.empty() || options_.timings; }
  // A regular expression that matches the channels subscribed to, and no other.
  const std::string& channels() const { return channels_; }
  // "sdf2d-slam" -> "SDF2D_SLAM_STATUS".
  const std::string& status_channel() const { return status_channel_; }

  // For the runners.
  void SetSink(Sink sink) { sink_ = std::move(sink); }
  // `waited_ms`: how long the event has waited since it arrived.
  void Dispatch(const Event& event, double waited_ms = 0.0);
  void Tick(int64_t now_utime);

 private:
  struct Subscription {
    std::regex pattern;
    Handler handler;
  };
  const std::vector<const Subscription*>& SubscriptionsTo(const std::string& channel);

  RunOptions options_;
  std::string status_channel_;
  std::string channels_;
  Health health_;
  Sink sink_;
  int64_t now_utime_ = 0;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::unordered_map<std::string, std::vector<const Subscription*>> by_channel_;
  std::vector<std::function<void(int64_t)>> every_second_;
};

// A process on the bus. Constructed with its context, where it subscribes; then events come until Finish().
class Service {
 public:
  virtual ~Service() = default;
  // The input has ended: write what is to be written. Called once; may publish.
  virtual void Finish() {}
};

using ServiceFactory = std::function<std::unique_ptr<Service>(ServiceContext&)>;

// Runs until SIGTERM or SIGINT, which let it finish what has arrived. Prints READY on stderr once subscribed.
ExitCode RunLive(ServiceContext& context, const ServiceFactory& make_service);
// Runs over options().log_in. The output holds every event of the input, each followed by what it caused.
ExitCode RunLogToLog(ServiceContext& context, const ServiceFactory& make_service);

}  // namespace lcmslam
