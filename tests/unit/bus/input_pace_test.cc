#include "bus/input_pace.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

constexpr int64_t kStart = 1'700'000'000'000'000;

// `count` inputs, a step after the other, stamped `stamp` and so on; returns the time of the last.
int64_t Feed(InputPace& input, int64_t utime, int64_t stamp, int count, int64_t step_us, int64_t stamp_step_us) {
  for (int i = 0; i < count; ++i) input.Note(stamp + i * stamp_step_us, utime + i * step_us, utime + i * step_us);
  return utime + (count - 1) * step_us;
}

TEST(InputPace, NothingIsKnownBeforeTheFirstInput) {
  InputPace input;
  const InputPaceReport report = input.Report(kStart);
  EXPECT_EQ(report.silent_s, 0.0);
  EXPECT_FALSE(report.IsSlow() || report.IsFast());
}

TEST(InputPace, TellsPaceAndRate) {
  for (const double pace : {0.1, 0.5, 1.0, 3.0, 50.0}) {
    InputPace input;
    const int64_t end = Feed(input, kStart, 5'000'000, 21, 50'000, std::llround(50'000 * pace));
    const InputPaceReport report = input.Report(end + 1'000);
    EXPECT_NEAR(report.pace, pace, 1e-9);
    EXPECT_NEAR(report.rate_hz, 20.0, 1e-9);
    EXPECT_EQ(report.IsSlow(), pace < 0.8);
    EXPECT_EQ(report.IsFast(), pace > 1.25);
  }
}

TEST(InputPace, StampsThatStandStillAreSlow) {
  InputPace input;
  const int64_t end = Feed(input, kStart, 5'000'000, 21, 50'000, 0);
  EXPECT_TRUE(input.Report(end).IsSlow());
}

TEST(InputPace, SilenceIsThreePeriodsAndHalfASecond) {
  for (const int64_t period_us : {10'000, 100'000, 1'000'000}) {
    const int64_t silent_us = std::max<int64_t>(500'000, 3 * period_us);
    for (const int64_t margin_us : {-1'000, 1'000}) {
      InputPace input;
      const int64_t end = Feed(input, kStart, 0, 30, period_us, period_us);
      EXPECT_EQ(input.Report(end).silent_s, 0.0);
      EXPECT_EQ(input.Report(end + silent_us + margin_us).silent_s > 0.0, margin_us > 0) << period_us;
    }
  }
}

TEST(InputPace, AfterSilenceItBeginsAnew) {
  InputPace input;
  int64_t end = Feed(input, kStart, 0, 20, 50'000, 50'000);
  EXPECT_GT(input.Report(end + 5'000'000).silent_s, 0.0);
  end = Feed(input, end + 5'000'000, 1'000'000, 11, 50'000, 50'000);
  EXPECT_NEAR(input.Report(end).pace, 1.0, 1e-9);
}

TEST(InputPace, AStepOfTheStampsIsNoPace) {
  for (const int64_t step_us : {-20'000'000, 100'000'000}) {
    InputPace input;
    int64_t end = Feed(input, kStart, 50'000'000, 10, 50'000, 50'000);
    end = Feed(input, end + 50'000, 50'450'000 + step_us, 10, 50'000, 50'000);
    EXPECT_NEAR(input.Report(end).pace, 1.0, 1e-9) << step_us;
  }
}

// As a reference and an estimate of it, which is late.
TEST(InputPace, TwoSendersNeedNotKeepTheOrderOfTheirStamps) {
  InputPace input;
  int64_t utime = kStart;
  for (int i = 0; i < 20; ++i, utime += 50'000) input.Note(50'000 * i - (i % 2) * 90'000, utime, utime);
  EXPECT_NEAR(input.Report(utime).pace, 1.0, 0.15);
}

// A service that was kept from running takes in one go what came meanwhile.
TEST(InputPace, WhatWaitedHereWasNeitherSilentNorFast) {
  InputPace input;
  const int64_t taken_utime = kStart + 4'000'000;
  for (int i = 0; i < 80; ++i) input.Note(50'000 * i, kStart + 50'000 * i, taken_utime);
  const InputPaceReport report = input.Report(taken_utime);
  EXPECT_NEAR(report.pace, 1.0, 1e-9);
  EXPECT_EQ(report.silent_s, 0.0);
}

// And what arrives in one go says nothing.
TEST(InputPace, BurstsAreNotCompared) {
  InputPace input;
  const int64_t end = Feed(input, kStart, 0, 100, 1'000, 50'000);
  EXPECT_EQ(input.Report(end).pace, 1.0);
}

}  // namespace
}  // namespace lcmslam
