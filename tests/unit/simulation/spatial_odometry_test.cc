#include "simulation/spatial_odometry.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

constexpr OdometryOptions kPerfect{.rate_hz = 20.0,
                                   .translation_scale_sigma = 0.0,
                                   .rotation_scale_sigma = 0.0,
                                   .translation_walk_m_per_sqrt_m = 0.0,
                                   .rotation_walk_rad_per_sqrt_m = 0.0,
                                   .rotation_walk_rad_per_sqrt_rad = 0.0};

// Curves through space for 10 s.
SpatialMotion Curve() {
  std::vector<MotionVector> points;
  for (int i = 0; i < 23; ++i) {
    MotionVector point;
    point << 0.4 * i, std::sin(0.5 * i), 0.2 * std::cos(0.7 * i), 0.3 * i, 0.2 * std::sin(0.9 * i), -0.1 * std::sin(i);
    points.push_back(point);
  }
  return {0.5, points};
}

// Straight along x at 1 m/s for 10 s, without a turn.
SpatialMotion Straight() {
  std::vector<MotionVector> points(23, MotionVector::Zero());
  for (size_t i = 0; i < points.size(); ++i) points[i][0] = 0.5 * static_cast<double>(i);
  return {0.5, points};
}

TEST(SpatialOdometry, WithoutErrorsIsTheMotion) {
  const SpatialMotion motion = Curve();
  const Trajectory odometry = SimulateSpatialOdometry(motion, 5'000'000, kPerfect, 1);
  ASSERT_EQ(odometry.size(), 201U);
  EXPECT_EQ(odometry[0].utime, 5'000'000);
  EXPECT_EQ(odometry[1].utime, 5'050'000);
  for (const StampedPose& sample : odometry) {
    const double t_s = 1e-6 * static_cast<double>(sample.utime - 5'000'000);
    const Pose3 T_odom_body = motion.PoseAt(0.0).inverse() * motion.PoseAt(t_s);
    EXPECT_TRUE((T_odom_body.translation - sample.pose.translation).isZero(1e-9));
    EXPECT_LT(AngleBetween(T_odom_body.rotation, sample.pose.rotation), 1e-7);
  }
}

TEST(SpatialOdometry, ErrorsGrowAsTheOptionsSay) {
  constexpr int kSeeds = 400;
  const auto spread = [](OdometryOptions options, const auto& coordinate) {
    double sum = 0.0, sum_of_squares = 0.0;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
      const double value = coordinate(SimulateSpatialOdometry(Straight(), 0, options, seed).back().pose);
      sum += value;
      sum_of_squares += value * value;
    }
    return std::sqrt(sum_of_squares / kSeeds - std::pow(sum / kSeeds, 2));
  };
  OdometryOptions scale = kPerfect, walk = kPerfect, turn = kPerfect;
  scale.translation_scale_sigma = 0.02;
  EXPECT_NEAR(spread(scale, [](const Pose3& p) { return p.translation.x(); }), 0.2, 0.02);
  walk.translation_walk_m_per_sqrt_m = 0.01;
  EXPECT_NEAR(spread(walk, [](const Pose3& p) { return p.translation.z(); }), 0.01 * std::sqrt(10.0), 0.004);
  turn.rotation_walk_rad_per_sqrt_m = 0.01;
  EXPECT_NEAR(spread(turn, [](const Pose3& p) { return Yaw(p.rotation); }), 0.01 * std::sqrt(10.0), 0.004);
}

TEST(SpatialOdometry, NoRateNoneAndSameSeedSame) {
  EXPECT_TRUE(SimulateSpatialOdometry(Curve(), 0, {}, 1).empty());
  const OdometryOptions options{.rate_hz = 10.0};
  const auto last = [&](uint64_t seed) { return SimulateSpatialOdometry(Curve(), 0, options, seed).back().pose; };
  EXPECT_EQ(last(3).translation, last(3).translation);
  EXPECT_NE(last(3).translation, last(4).translation);
}

}  // namespace
}  // namespace lcmslam
