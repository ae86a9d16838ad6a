#include "baselines/occupancy2d_odometry.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lcmslam::occupancy2d {
namespace {

constexpr int64_t kMs = 1000;

void ExpectNear(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x(), b.x(), 1e-9);
  EXPECT_NEAR(a.y(), b.y(), 1e-9);
  EXPECT_NEAR(a.yaw(), b.yaw(), 1e-9);
}

TEST(OdometryGuess, NothingSaidNoMotion) {
  OdometryGuess guess;
  ExpectNear(guess.MotionUntil(0), {});
  ExpectNear(guess.MotionUntil(100 * kMs), {});
}

TEST(OdometryGuess, MotionIsInTheBodyFrameOfTheLastScan) {
  const Pose2 step(0.1, 0.02, 0.3);
  OdometryGuess guess;
  Pose2 T_odom_body(5.0, -3.0, 2.0);
  guess.Add(0, T_odom_body);
  guess.MotionUntil(0);
  for (int i = 1; i <= 20; ++i) {
    T_odom_body = T_odom_body * step;
    guess.Add(i * 100 * kMs, T_odom_body);
    ExpectNear(guess.MotionUntil(i * 100 * kMs), step);
  }
}

TEST(OdometryGuess, InterpolatesBetweenItsStamps) {
  OdometryGuess guess;
  for (int i = 0; i <= 10; ++i) guess.Add(i * 20 * kMs, {0.02 * i, 0.0, 0.0});
  guess.MotionUntil(50 * kMs);
  ExpectNear(guess.MotionUntil(130 * kMs), {0.08, 0.0, 0.0});
}

TEST(OdometryGuess, TheLastSampleStandsForAWhile) {
  OdometryGuess guess;
  guess.Add(0, {1.0, 0.0, 0.0});
  guess.MotionUntil(0);
  guess.Add(90 * kMs, {2.0, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(100 * kMs), {1.0, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(500 * kMs), {});  // too old
  guess.Add(600 * kMs, {9.0, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(600 * kMs), {});  // nothing known at the scan before
}

TEST(OdometryGuess, StartsAfreshWhenTimeJumpsBack) {
  OdometryGuess guess;
  guess.Add(5000 * kMs, {5.0, 0.0, 0.0});
  guess.MotionUntil(5000 * kMs);
  guess.Add(1000 * kMs, {7.0, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(1000 * kMs), {});
  guess.Add(1100 * kMs, {7.5, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(1100 * kMs), {0.5, 0.0, 0.0});
}

TEST(OdometryGuess, DropsWhatIsNotAPoseOrNotNew) {
  OdometryGuess guess;
  guess.Add(0, {0.0, 0.0, 0.0});
  guess.Add(0, {3.0, 0.0, 0.0});
  guess.MotionUntil(0);
  guess.Add(100 * kMs, {NAN, 0.0, 0.0});
  guess.Add(100 * kMs, {0.2, 0.0, INFINITY});
  guess.Add(100 * kMs, {0.1, 0.0, 0.0});
  ExpectNear(guess.MotionUntil(100 * kMs), {0.1, 0.0, 0.0});
}

TEST(OdometryGuess, OutlivesScansThatDoNotCome) {
  OdometryGuess guess;
  for (int i = 0; i < 100'000; ++i) guess.Add(i * kMs, {0.001 * i, 0.0, 0.0});
  guess.MotionUntil(99'900 * kMs);
  ExpectNear(guess.MotionUntil(99'999 * kMs), {0.099, 0.0, 0.0});
}

}  // namespace
}  // namespace lcmslam::occupancy2d
