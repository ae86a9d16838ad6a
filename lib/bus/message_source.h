#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "bus/log_reader.h"

namespace lcmslam {

class LiveBus;

// The messages of a live bus as they arrive. One thread.
class MessageSource {
 public:
  virtual ~MessageSource() = default;
  // The next message, with the wall-clock time of its arrival; none when none is there in time. Throws CommandError
  // (kRuntime) when the connection broke.
  [[nodiscard]] virtual std::optional<Event> Next(std::chrono::milliseconds timeout) = 0;
};

// Hears the channels that match the regular expression `channels` as a whole. `bus` has to outlive the source.
//
// UDP multicast is read by a reader of our own and not by liblcm 1.3.1, which dies of two crafted fragments, drops
// messages whose fragments change places, knows when a message arrived only now and then, and keeps the memory of the
// largest backlog it ever had. The other kinds of bus are liblcm's.
std::unique_ptr<MessageSource> OpenMessageSource(LiveBus& bus, const std::string& channels);

}  // namespace lcmslam
