// arrivals LOG CHANNEL: the messages of a channel in an LCM log, a line each: log time and the message's own stamp (s).
// Separated by tabs.
#include <fmt/format.h>

#include "bus/errors.h"
#include "bus/log_reader.h"

namespace lcmslam {
namespace {

// Every message of ours begins with its fingerprint and its utime.
constexpr size_t kFingerprintBytes = 8, kStampBytes = 8;

int64_t StampOf(const Event& event) {
  uint64_t utime = 0;
  for (size_t i = 0; i < kStampBytes; ++i) utime = utime << 8 | event.data[kFingerprintBytes + i];
  return static_cast<int64_t>(utime);
}

void PrintArrivals(const char* path, const std::string& channel) {
  LogReader log(path);
  for (Event event; log.Next(event);) {
    if (event.channel != channel || event.data.size() < kFingerprintBytes + kStampBytes) continue;
    fmt::print("{:.3f}\t{:.3f}\n", static_cast<double>(event.utime) / 1e6, static_cast<double>(StampOf(event)) / 1e6);
  }
}

}  // namespace
}  // namespace lcmslam

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: arrivals LOG CHANNEL\n");
    return static_cast<int>(lcmslam::ExitCode::kUsage);
  }
  try {
    lcmslam::PrintArrivals(argv[1], argv[2]);
  } catch (const lcmslam::CommandError& error) {
    fmt::print(stderr, "arrivals: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
