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
  health.NoteInput("SCAN", 1'000'000);
  EXPECT_EQ(health.Report(0, true).state, int{service_status_t::OK});
  EXPECT_EQ(health.Report(1, true).state, int{service_status_t::WAITING});
  EXPECT_EQ(health.Report(2, true).text, "no input for 2 s");
  health.NoteInput("SCAN", 1'050'000);
  const service_status_t status = health.Report(3, true);
  EXPECT_EQ(status.state, int{service_status_t::OK});
  EXPECT_EQ(status.text, "");
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
