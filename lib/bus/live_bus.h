#pragma once

#include <memory>
#include <string>

#include "bus/lcm_url.h"
#include "bus/wire.h"

namespace lcm {
class LCM;
}

namespace lcmslam {

// A connection to a running LCM bus, for publishing only (receiving: LiveReceiver).
// For `url` see CheckedLcmUrl(), whose errors it throws, and CommandError (kRuntime) where the bus cannot be reached.
// Publish from one thread at a time.
class LiveBus {
 public:
  explicit LiveBus(const std::string& url);
  ~LiveBus();

  void Publish(const std::string& channel, Bytes data);
  lcm::LCM& lcm() { return *lcm_; }
  const LcmUrl& url() const { return url_; }

 private:
  LcmUrl url_;
  std::unique_ptr<lcm::LCM> lcm_;
};

}  // namespace lcmslam
