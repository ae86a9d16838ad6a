#pragma once

#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

#include "geometry/utime.h"

namespace lcmslam {

// Puts items into the order of their stamps where they are out of it by less than a horizon, as loggers with several
// sources and scans stamped with their last beam leave them. Equal stamps keep their order. A stamp that jumps back
// further is a clock that was set: what is held goes out first, and the order of the file is kept.
template <class Item>
class TimeOrder {
 public:
  explicit TimeOrder(int64_t horizon_us) : horizon_us_(horizon_us) {}

  // Calls `emit(utime, item)` for every item whose turn has come.
  template <class Emit>
  void Push(int64_t utime, Item item, const Emit& emit) {
    if (!waiting_.empty() && UtimeDifference(newest_utime_, utime) > horizon_us_) {
      ++jumps_;
      Flush(emit);
    }
    newest_utime_ = waiting_.empty() ? utime : std::max(newest_utime_, utime);
    waiting_.push({utime, sequence_++, std::move(item)});
    while (UtimeDifference(newest_utime_, waiting_.top().utime) > horizon_us_) EmitFirst(emit);
  }
  template <class Emit>
  void Flush(const Emit& emit) {
    while (!waiting_.empty()) EmitFirst(emit);
  }

  // How often a stamp jumped back beyond the horizon.
  int64_t jumps() const { return jumps_; }

 private:
  struct Waiting {
    int64_t utime;
    int64_t sequence;
    Item item;
    bool operator<(const Waiting& other) const {  // the queue's top is its greatest
      return std::pair(utime, sequence) > std::pair(other.utime, other.sequence);
    }
  };

  template <class Emit>
  void EmitFirst(const Emit& emit) {
    const Waiting& first = waiting_.top();
    emit(first.utime, first.item);
    waiting_.pop();
  }

  int64_t horizon_us_;
  int64_t newest_utime_ = 0;
  int64_t sequence_ = 0;
  int64_t jumps_ = 0;
  std::priority_queue<Waiting> waiting_;
};

}  // namespace lcmslam
