#include "bus/live_receiver.h"

#include <algorithm>
#include <utility>

#include <malloc.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReceiveTimeout{20};
constexpr milliseconds kQuiet{100};          // no message for this long: the bus is drained
constexpr milliseconds kDrainLimit{2000};    // a bus that never falls silent
constexpr size_t kBacklogBytes = 512 << 10;  // more than one sweep

}  // namespace

LiveReceiver::LiveReceiver(LiveBus& bus, const std::string& channels, size_t capacity_messages)
    : source_(OpenMessageSource(bus, channels)), capacity_(capacity_messages) {
  mallopt(M_ARENA_MAX, 1);  // of a thread's own arena malloc_trim() gives back but a part
  thread_ = std::thread([this] { Receive(); });
}

LiveReceiver::~LiveReceiver() {
  Drain();
  thread_.join();
}

void LiveReceiver::Receive() {
  auto last_message = steady_clock::now();
  std::optional<steady_clock::time_point> drain_start;
  while (true) {
    std::optional<Event> event = NextFromSource();
    const auto now = steady_clock::now();
    const std::lock_guard lock(mutex_);
    if (event) {
      last_message = now;
      Enqueue(std::move(*event));
    }
    if (draining_ && !drain_start) drain_start = now;
    const bool quiet =
        drain_start && (now - std::max(last_message, *drain_start) > kQuiet || now - *drain_start > kDrainLimit);
    if (failed_ || quiet) {
      done_ = true;
      arrived_.notify_one();
      return;
    }
  }
}

std::optional<Event> LiveReceiver::NextFromSource() {
  try {
    return source_->Next(kReceiveTimeout);
  } catch (const CommandError&) {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    return {};
  }
}

void LiveReceiver::Enqueue(Event event) {
  if (queue_.size() >= capacity_) {
    ++dropped_;
    return;
  }
  queued_bytes_ += event.data.size();
  backlogged_ = backlogged_ || queued_bytes_ > kBacklogBytes;
  queue_.push_back(std::move(event));
  arrived_.notify_one();
}

std::optional<Event> LiveReceiver::Pop(milliseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, timeout, [&] { return !queue_.empty() || done_; });
  if (queue_.empty()) return {};
  Event event = std::move(queue_.front());
  queue_.pop_front();
  queued_bytes_ -= event.data.size();
  const bool backlog_ended = queue_.empty() && std::exchange(backlogged_, false);
  lock.unlock();
  if (backlog_ended) malloc_trim(0);
  return event;
}

void LiveReceiver::Drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

bool LiveReceiver::drained() const {
  const std::lock_guard lock(mutex_);
  return done_ && queue_.empty();
}

int64_t LiveReceiver::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

bool LiveReceiver::failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

}  // namespace lcmslam
