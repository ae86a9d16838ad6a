#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "bus/log_reader.h"
#include "bus/wire.h"

namespace lcm {
class LCM;
}

namespace lcmslam {

// A connection to a running LCM bus, for publishing only (receiving: LiveReceiver).
// "" means $LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152. Throws CommandError: kUsage
// for a malformed URL, kRuntime where the bus cannot be reached. Publish from one thread at a time.
class LiveBus {
 public:
  explicit LiveBus(const std::string& url);
  ~LiveBus();

  void Publish(const std::string& channel, Bytes data);
  lcm::LCM& lcm() { return *lcm_; }
  const std::string& url() const { return url_; }

 private:
  std::string url_;
  std::unique_ptr<lcm::LCM> lcm_;
};

// Receives the channels that match a regular expression as a whole, in its own thread, so that a slow handler fills
// this queue, whose overflow is counted, and not the ones below it, which lose in silence. Pop from one thread.
class LiveReceiver {
 public:
  LiveReceiver(LiveBus& bus, const std::string& channels, size_t capacity_messages);
  ~LiveReceiver();

  // The oldest waiting message, with the wall-clock time of its arrival; none when there is none within the timeout,
  // or, after Drain(), no more to come.
  std::optional<Event> Pop(std::chrono::milliseconds timeout);

  // Stops receiving once the bus has been quiet for a moment; what has arrived can still be popped.
  void Drain();
  bool drained() const;
  // Messages that found the queue full.
  int64_t dropped() const;
  // Set when the connection broke; no more messages come.
  bool failed() const;

 private:
  void Receive();
  int64_t ArrivalUtime(int64_t read_utime);

  LiveBus& bus_;
  size_t capacity_;
  // Of the receiving thread alone:
  std::chrono::steady_clock::time_point turn_;         // since when it waits for the next message
  std::chrono::steady_clock::time_point backlog_end_;  // until then come messages that arrived during a hold-up,
  int64_t hold_up_utime_ = 0;                          // which began here
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> queue_;
  int64_t dropped_ = 0;
  bool draining_ = false, done_ = false, failed_ = false;
  std::thread thread_;
};

// Microseconds since 1970.
int64_t WallClockUtime();

}  // namespace lcmslam
