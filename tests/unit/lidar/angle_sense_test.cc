#include "lidar/angle_sense.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

// n beams, `step_rad` apart from `first_rad` on, in [0, 2 pi), 400 us apart, the first one at 1 s.
struct Turn {
  std::vector<int64_t> times;
  std::vector<float> angles;

  Turn(int n, double first_rad, double step_rad) {
    for (int i = 0; i < n; ++i) {
      times.push_back(1'000'000 + 400 * i);
      const double angle = first_rad + step_rad * i;
      angles.push_back(static_cast<float>(angle - 2.0 * std::numbers::pi * std::floor(angle / 2.0 / std::numbers::pi)));
    }
  }
  AngleSense StampedFirst() const { return DetectAngleSense(times.front(), times, angles); }
  AngleSense StampedLast() const { return DetectAngleSense(times.back(), times, angles); }
};

TEST(AngleSense, RawRpLidarCountsClockwise) {
  EXPECT_EQ(Turn(300, 0.0, 0.0205).StampedFirst(), AngleSense::kClockwise);
  EXPECT_EQ(Turn(300, 5.0, 0.0205).StampedFirst(), AngleSense::kClockwise) << "wraps on the way";
}

TEST(AngleSense, EverythingElseCountsCounterClockwise) {
  EXPECT_EQ(Turn(300, 0.0, 0.0205).StampedLast(), AngleSense::kCounterClockwise) << "ours";
  EXPECT_EQ(Turn(300, 0.0, -0.0205).StampedFirst(), AngleSense::kCounterClockwise) << "mirrored by its driver";
  EXPECT_EQ(Turn(667, -2.09, 0.00628).StampedFirst(), AngleSense::kCounterClockwise) << "no full turn";
  Turn untimed(300, 0.0, 0.0205);
  untimed.times.assign(300, 1'000'000);
  EXPECT_EQ(untimed.StampedFirst(), AngleSense::kCounterClockwise);
  EXPECT_EQ(Turn(1, 0.0, 1.0).StampedFirst(), AngleSense::kCounterClockwise);
  EXPECT_EQ(DetectAngleSense(5, {}, {}), AngleSense::kCounterClockwise);
}

TEST(AngleSense, PassesOverNonFiniteAngles) {
  Turn turn(300, 0.0, 0.0205);
  for (size_t i = 0; i < turn.angles.size(); i += 7) turn.angles[i] = NAN;
  EXPECT_EQ(turn.StampedFirst(), AngleSense::kClockwise);
  turn.angles.assign(300, INFINITY);
  EXPECT_EQ(turn.StampedFirst(), AngleSense::kCounterClockwise);
}

}  // namespace
}  // namespace lcmslam
