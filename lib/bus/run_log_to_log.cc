#include <optional>

#include <fmt/format.h>

#include "bus/log_writer.h"
#include "bus/progress.h"
#include "bus/service.h"
#include "bus/signals.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kSecondUs = 1'000'000;

// One tick for every second of log time; a jump starts a new count.
class LogTimer {
 public:
  bool Elapsed(int64_t utime) {
    const bool jumped =
        !started_ || UtimeDifference(utime, next_) < -kSecondUs || UtimeDifference(utime, next_) > 10 * kSecondUs;
    const bool elapsed = started_ && utime >= next_;
    if (jumped) {
      next_ = utime + kSecondUs;
    } else if (elapsed) {
      next_ += kSecondUs;
    }
    started_ = true;
    return elapsed;
  }

 private:
  int64_t next_ = 0;
  bool started_ = false;
};

std::optional<LogWriter> OpenOutput(const RunOptions& options) {
  if (options.log_out.empty()) return {};
  std::error_code not_there;
  if (std::filesystem::equivalent(options.log_in, options.log_out, not_there)) {
    throw CommandError(ExitCode::kUsage, "--log-out: is the same file as --log-in");
  }
  return std::optional<LogWriter>(std::in_place, options.log_out);
}

}  // namespace

ExitCode RunLogToLog(ServiceContext& context, const ServiceFactory& make_service) {
  CatchStopSignals();
  LogReader reader(context.options().log_in);
  std::optional<LogWriter> writer = OpenOutput(context.options());
  context.SetSink([&](int64_t utime, const std::string& channel, Bytes data) {
    if (writer) writer->Write(utime, channel, data);
  });
  const std::unique_ptr<Service> service = make_service(context);
  fmt::print(stderr, "READY\n");

  Progress progress(reader.size_bytes(), context.options().quiet);
  LogTimer second;
  int64_t last_utime = 0;
  for (Event event; !StopRequested() && reader.Next(event); last_utime = event.utime) {
    if (second.Elapsed(event.utime)) context.Tick(event.utime);
    if (writer) writer->Write(event.utime, event.channel, event.data);
    context.Dispatch(event);
    progress.Show(reader.position_bytes());
  }
  service->Finish();
  context.Tick(last_utime);
  if (writer) writer->Flush();

  const std::string damage = reader.DamageReport();
  if (!damage.empty()) fmt::print(stderr, "{}\n", damage);
  return reader.damaged_bytes() > 0 ? ExitCode::kBadInput : ExitCode::kOk;
}

}  // namespace lcmslam
