#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "bus/clock.h"
#include "bus/live_bus.h"
#include "bus/live_receiver.h"
#include "bus/service.h"
#include "bus/signals.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Wall-clock seconds, one tick each, none made up for when handling takes longer than that.
class SecondTimer {
 public:
  bool Elapsed() {
    const auto now = steady_clock::now();
    if (now < next_) return false;
    next_ = std::max(next_, now - kTooLate) + std::chrono::seconds(1);
    return true;
  }

 private:
  static constexpr milliseconds kTooLate{500};
  steady_clock::time_point next_ = steady_clock::now() + std::chrono::seconds(1);
};

}  // namespace

ExitCode RunLive(ServiceContext& context, const ServiceFactory& make_service) {
  CatchStopSignals();
  LiveBus bus(context.options().lcm_url);
  context.SetSink([&](int64_t, const std::string& channel, Bytes data) { bus.Publish(channel, data); });
  const std::unique_ptr<Service> service = make_service(context);
  LiveReceiver receiver(bus, context.channels(), static_cast<size_t>(context.options().queue_messages));
  fmt::print(stderr, "READY\n");

  SecondTimer second;
  while (!receiver.drained()) {
    if (StopRequested()) receiver.Drain();
    if (const auto arrival = receiver.Pop(milliseconds(50))) {
      const double waited_ms = static_cast<double>(UtimeDifference(WallClockUtime(), arrival->utime)) / 1e3;
      context.Dispatch(*arrival, std::max(0.0, waited_ms));
    }
    context.health().SetDropped(receiver.dropped());
    if (second.Elapsed()) context.Tick(WallClockUtime());
  }
  service->Finish();
  context.Tick(WallClockUtime());
  if (receiver.failed())
    throw CommandError(ExitCode::kRuntime, fmt::format("LCM URL '{}': the connection broke", bus.url().text));
  return ExitCode::kOk;
}

}  // namespace lcmslam
