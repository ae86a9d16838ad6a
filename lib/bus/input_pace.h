#pragma once

#include <cstdint>
#include <optional>

namespace lcmslam {

// How a periodic input came in since the last report.
struct InputPaceReport {
  double silent_s = 0.0;  // more than 0: for so long nothing has come, which is long for this input
  double pace = 1.0;      // seconds of its stamps per second; 1 where it is not known
  double rate_hz = 0.0;   // 0 where it is not known

  bool IsSlow() const { return pace < 0.8; }
  bool IsFast() const { return pace > 1.25; }
};

// Compares the stamps of a periodic input with the clock. All times in us; one thread.
class InputPace {
 public:
  // An input stamped `stamp_utime` arrived at `arrival_utime` and is taken now. What waits here to be taken is not
  // silent, and what waited has not come faster.
  void Note(int64_t stamp_utime, int64_t arrival_utime, int64_t now_utime);
  // What came since the last report; starts the next period.
  InputPaceReport Report(int64_t now_utime);

 private:
  struct Arrival {
    int64_t stamp_utime = 0, utime = 0;
  };
  std::optional<Arrival>
      first_;  // of the period, or the last of the one before; none after silence or a step of the stamps
  Arrival last_;
  int64_t taken_utime_ = 0;
  int64_t since_first_ = 0;  // inputs
  int64_t period_us_ = 350'000;
  bool any_ = false;
};

}  // namespace lcmslam
