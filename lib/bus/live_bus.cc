#include "bus/live_bus.h"

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include "bus/errors.h"

namespace lcmslam {

LiveBus::LiveBus(const std::string& url) : url_(CheckedLcmUrl(url)) {
  lcm_ = std::make_unique<lcm::LCM>(url_.text);
  if (!lcm_->good())
    throw CommandError(ExitCode::kRuntime,
                       fmt::format("LCM URL '{}': the bus cannot be opened (is there a multicast route?)", url_.text));
}

LiveBus::~LiveBus() = default;

void LiveBus::Publish(const std::string& channel, Bytes data) {
  if (lcm_->publish(channel, data.data(), static_cast<unsigned>(data.size())) != 0) {
    throw CommandError(ExitCode::kRuntime,
                       fmt::format("LCM URL '{}': publishing {} bytes on {} failed", url_.text, data.size(), channel));
  }
}

}  // namespace lcmslam
