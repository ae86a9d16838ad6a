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
#include "bus/message_source.h"

namespace lcmslam {

// Receives the channels that match a regular expression as a whole, in its own thread, so that a slow handler fills
// this queue, whose overflow is counted, and not the kernel's. What a backlog has cost in memory is given back once it
// is worked off. Pop from one thread.
class LiveReceiver {
 public:
  // Throws as OpenMessageSource() does.
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
  std::optional<Event> NextFromSource();
  void Enqueue(Event event);

  std::unique_ptr<MessageSource> source_;  // of the receiving thread alone
  size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> queue_;
  size_t queued_bytes_ = 0;
  bool backlogged_ = false;  // since the queue was empty
  int64_t dropped_ = 0;
  bool draining_ = false, done_ = false, failed_ = false;
  std::thread thread_;
};

}  // namespace lcmslam
