#include "sensor-bridge/time_order.h"

#include <string>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

// Pushes stamps; the items are their indices in the input. Returns "stamp:index " of all that came out.
std::string Order(const std::vector<int64_t>& stamps, int64_t horizon_us, int64_t* jumps = nullptr) {
  TimeOrder<size_t> order(horizon_us);
  std::string out;
  const auto emit = [&](int64_t utime, size_t item) {
    out += std::to_string(utime) + ":" + std::to_string(item) + " ";
  };
  for (size_t i = 0; i < stamps.size(); ++i) order.Push(stamps[i], i, emit);
  order.Flush(emit);
  if (jumps != nullptr) *jumps = order.jumps();
  return out;
}

TEST(TimeOrder, SortsWithinTheHorizon) {
  EXPECT_EQ(Order({10, 30, 20, 40}, 15), "10:0 20:2 30:1 40:3 ");
  EXPECT_EQ(Order({10, 10, 5, 10}, 15), "5:2 10:0 10:1 10:3 ") << "equal stamps keep their order";
  EXPECT_EQ(Order({}, 15), "");
}

TEST(TimeOrder, HandsOnWhatTheHorizonHasPassed) {
  TimeOrder<int> order(10);
  int emitted = 0;
  const auto emit = [&](int64_t, int) { ++emitted; };
  order.Push(0, 0, emit);
  order.Push(10, 0, emit);
  EXPECT_EQ(emitted, 0);
  order.Push(11, 0, emit);
  EXPECT_EQ(emitted, 1);
}

TEST(TimeOrder, AClockThatWasSetBackKeepsTheOrderOfTheFile) {
  int64_t jumps = 0;
  EXPECT_EQ(Order({100, 110, 5, 3, 20}, 15, &jumps), "100:0 110:1 3:3 5:2 20:4 ");
  EXPECT_EQ(jumps, 1);
}

TEST(TimeOrder, ExtremeStampsDoNotOverflow) {
  int64_t jumps = 0;
  EXPECT_EQ(Order({INT64_MAX, INT64_MIN}, 15, &jumps),
            std::to_string(INT64_MAX) + ":0 " + std::to_string(INT64_MIN) + ":1 ");
  EXPECT_EQ(jumps, 1);
}

}  // namespace
}  // namespace lcmslam
