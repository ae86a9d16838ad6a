// status_lines LOG: the statuses of all services in an LCM log, a line each: log time (s), service, state, received,
// processed, dropped, refused, missing, p99 latency (ms), resident memory (MB), text, dropped by the kernel. Separated
// by tabs.
#include <array>

#include <fmt/format.h>
#include <lcmslam/service_status_t.hpp>

#include "bus/errors.h"
#include "bus/log_reader.h"
#include "bus/wire.h"

namespace lcmslam {
namespace {

void PrintStatuses(const char* path) {
  constexpr std::array kStates{"STARTING", "WAITING", "OK", "DEGRADED", "FAILED"};
  LogReader log(path);
  for (Event event; log.Next(event);) {
    if (!event.channel.ends_with("_STATUS")) continue;
    const auto s = Decode<service_status_t>(event.data);
    if (!s) continue;
    fmt::print("{:.2f}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.3f}\t{:.1f}\t{}\t{}\n", static_cast<double>(event.utime) / 1e6,
               s->name, kStates.at(static_cast<size_t>(s->state)), s->received, s->processed, s->dropped, s->refused,
               s->missing, s->latency_p99_ms, s->rss_mb, s->text, s->kernel_dropped);
  }
}

}  // namespace
}  // namespace lcmslam

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: status_lines LOG\n");
    return static_cast<int>(lcmslam::ExitCode::kUsage);
  }
  try {
    lcmslam::PrintStatuses(argv[1]);
  } catch (const lcmslam::CommandError& error) {
    fmt::print(stderr, "status_lines: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
