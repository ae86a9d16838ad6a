#include "bus/health.h"

#include <gtest/gtest.h>
#include <lcmslam/service_status_t.hpp>

namespace lcmslam {
namespace {

TEST(GapCounter, CountsWhatTheSenderSkipped) {
  GapCounter gaps;
  int64_t missing = 0;
  // 20 Hz with a millisecond of jitter; messages 30, 31 and 60 never come.
  for (int64_t i = 0; i < 100; ++i) {
    if (i != 30 && i != 31 && i != 60) missing += gaps.Missing(50'000 * i + (i % 3) * 500);
  }
  EXPECT_EQ(missing, 3);
}

TEST(GapCounter, RepeatedAndBackwardStampsAreNoGaps) {
  GapCounter gaps;
  int64_t missing = 0;
  for (int64_t i = 0; i < 20; ++i) missing += gaps.Missing(1000 * i);
  for (const int64_t utime : {19'000, 5'000, 6'000, 7'000}) missing += gaps.Missing(utime);
  EXPECT_EQ(missing, 0);
}

TEST(Health, StateFollowsTheLosses) {
  Health health("x");
  EXPECT_EQ(health.Report(0, false).state, int{service_status_t::WAITING});
  health.CountReceived();
  health.CountProcessed();
  EXPECT_EQ(health.Report(1, false).state, int{service_status_t::OK});
  health.CountRefused();
  EXPECT_EQ(health.Report(2, false).state, int{service_status_t::DEGRADED});
  EXPECT_EQ(health.Report(3, false).state, int{service_status_t::OK}) << "nothing new was lost";
}

TEST(Health, LatencyQuantilesOfTheLastReport) {
  Health health("x");
  for (int i = 100; i >= 1; --i) health.NoteLatency(i, 1.0);
  const service_status_t status = health.Report(0, true);
  EXPECT_EQ(status.latency_p50_ms, 50.0F);
  EXPECT_EQ(status.latency_p95_ms, 95.0F);
  EXPECT_EQ(status.latency_p99_ms, 99.0F);
  EXPECT_GT(status.rss_mb, 0.0F);
  EXPECT_EQ(health.Report(1, true).latency_p99_ms, 0.0F);
}

TEST(Health, SaysOnWhichChannelMessagesAreMissing) {
  Health health("x");
  for (const int64_t i : {0, 1, 2, 3, 4, 5, 6, 9, 10, 11}) {
    health.CountProcessed();
    health.NoteInput("SCAN", 50'000 * i + 1'000'000);
    health.NoteInput("POSE", 50'000 * i + 1'000'000 + (i >= 9 ? -100'000 : 0));
  }
  health.SetText("busy");
  const service_status_t status = health.Report(0, true);
  EXPECT_EQ(status.missing, 2);
  EXPECT_EQ(status.text, "2 missing on SCAN; busy");
  EXPECT_EQ(health.Summary(), "x: 0 received, 10 processed, 2 missing on SCAN; busy");
}

TEST(Health, StarvedWhenTheInputStandsStill) {
  Health health("x");
  health.CountProcessed();
  health.BeginEvent(1'000'000, 1'000'000);
  health.NoteInput("SCAN", 70'000'000);
  EXPECT_EQ(health.Report(1'100'000, true).state, int{service_status_t::OK});
  EXPECT_EQ(health.Report(2'100'000, true).state, int{service_status_t::WAITING});
  EXPECT_EQ(health.Report(3'100'000, true).text, "no input for 2.1 s");
  health.BeginEvent(4'000'000, 4'000'000);
  health.NoteInput("SCAN", 73'000'000);
  const service_status_t status = health.Report(4'100'000, true);
  EXPECT_EQ(status.state, int{service_status_t::OK});
  EXPECT_EQ(status.text, "");
}

TEST(Health, SaysHowSlowOrFastTheInputComes) {
  Health health("x");
  health.CountProcessed();
  int64_t now_utime = 1'000'000;
  const auto report_after_second = [&](int inputs, int64_t stamp_step_us) {
    static int64_t stamp_utime = 0;
    for (int i = 0; i < inputs; ++i) {
      now_utime += 1'000'000 / inputs;
      health.BeginEvent(now_utime, now_utime);
      health.NoteStamp(stamp_utime += stamp_step_us);
    }
    return health.Report(now_utime, true);
  };
  EXPECT_EQ(report_after_second(10, 100'000).text, "");
  service_status_t status = report_after_second(4, 100'000);
  EXPECT_EQ(status.text, "input at 0.40 of real time, 4.0 Hz");
  EXPECT_EQ(status.state, int{service_status_t::DEGRADED});
  status = report_after_second(200, 100'000);
  EXPECT_EQ(status.text, "input at 20.0 times real time, 200 Hz");
  EXPECT_EQ(status.state, int{service_status_t::OK}) << "as long as nothing is lost";
  EXPECT_EQ(report_after_second(10, 100'000).text, "");
}

// A flood of two channels, of which one lags seconds of stamps behind the other.
TEST(Health, ALaggingChannelDoesNotHideThePace) {
  Health health("x");
  health.CountProcessed();
  for (int64_t i = 0; i < 200; ++i) {
    health.BeginEvent(1'000'000 + 5'000 * i, 1'000'000 + 5'000 * i);
    health.NoteInput("TRUTH", 100'000'000 + 100'000 * i);
    health.NoteInput("ESTIMATE", 95'000'000 + 100'000 * i);
  }
  EXPECT_EQ(health.Report(2'000'000, true).text, "input at 20.0 times real time, 200 Hz");
}

TEST(Health, SilentOnlyWhenAllInputsAre) {
  Health health("x");
  health.CountProcessed();
  for (int64_t i = 0; i < 30; ++i) {
    health.BeginEvent(1'000'000 + 100'000 * i, 1'000'000 + 100'000 * i);
    health.NoteInput("TRUTH", 100'000 * i);
    if (i < 10) health.NoteInput("ESTIMATE", 100'000 * i);
  }
  EXPECT_EQ(health.Report(4'000'000, true).text, "");
  EXPECT_EQ(health.Report(5'000'000, true).text, "no input for 1.1 s");
}

TEST(Health, WithoutWallClockNothingVaries) {
  Health health("x");
  health.NoteLatency(3.0, 2.0);
  const service_status_t status = health.Report(0, false);
  EXPECT_EQ(status.latency_p50_ms, 0.0F);
  EXPECT_EQ(status.rss_mb, 0.0F);
  EXPECT_EQ(status.kernel_dropped, 0);
}

}  // namespace
}  // namespace lcmslam
