#include "simulation/planar_odometry.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr OdometryOptions kPerfect{.rate_hz = 50.0,
                                   .translation_scale_sigma = 0.0,
                                   .rotation_scale_sigma = 0.0,
                                   .translation_walk_m_per_sqrt_m = 0.0,
                                   .rotation_walk_rad_per_sqrt_m = 0.0,
                                   .rotation_walk_rad_per_sqrt_rad = 0.0};

// 16 m and 4 rad in 20 s.
PlanarMotion Arc() { return {1'000'000, 20'000'000, Pose2(3.0, 1.0, 2.0), {Vector3d(0.8, 0.0, 0.2)}}; }

TEST(PlanarOdometry, WithoutErrorsIsTheMotion) {
  const PlanarMotion motion = Arc();
  const auto samples = SimulateOdometry(motion, kPerfect, 1);
  ASSERT_EQ(samples.size(), 1001U);
  EXPECT_EQ(samples[0].utime, 1'000'000);
  EXPECT_EQ(samples[1].utime, 1'020'000);
  EXPECT_EQ(samples.back().utime, 21'000'000);
  const Pose2 T_odom_world = motion.PoseAt(1'000'000).inverse();
  for (const OdometrySample& sample : samples) {
    const Pose2 T_odom_body = T_odom_world * motion.PoseAt(sample.utime);
    EXPECT_TRUE((T_odom_body.inverse() * sample.T_odom_body).Log().isZero(1e-9));
    if (sample.utime > 1'000'000) {
      EXPECT_TRUE(sample.twist_body.isApprox(Vector3d(0.8, 0.0, 0.2), 1e-9));
    }
  }
}

struct Spread {
  Vector3d mean = Vector3d::Zero();
  Vector3d sigma = Vector3d::Zero();
};

// Of what odometry says of the whole arc, as way forward (straightened), sideways, angle.
Spread SpreadOverSeeds(const OdometryOptions& options) {
  constexpr int kSeeds = 400;
  Vector3d sum = Vector3d::Zero();
  Vector3d sum_of_squares = Vector3d::Zero();
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    Vector3d total = Vector3d::Zero();
    for (const OdometrySample& sample : SimulateOdometry(Arc(), options, seed))
      total += sample.twist_body / options.rate_hz;
    sum += total;
    sum_of_squares += total.cwiseAbs2();
  }
  const Vector3d mean = sum / kSeeds;
  return {mean, (sum_of_squares / kSeeds - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt()};
}

TEST(PlanarOdometry, ScaleErrorsGrowWithTheWay) {
  OdometryOptions options = kPerfect;
  options.translation_scale_sigma = 0.01;
  options.rotation_scale_sigma = 0.02;
  const Spread spread = SpreadOverSeeds(options);
  EXPECT_TRUE(spread.mean.isApprox(Vector3d(16.0, 0.0, 4.0), 0.005));
  EXPECT_NEAR(spread.sigma.x(), 0.01 * 16.0, 0.02);
  EXPECT_NEAR(spread.sigma.z(), 0.02 * 4.0, 0.01);
}

TEST(PlanarOdometry, WalksGrowWithTheSquareRootOfTheWay) {
  OdometryOptions options = kPerfect;
  options.translation_walk_m_per_sqrt_m = 0.02;
  options.rotation_walk_rad_per_sqrt_m = 0.01;
  options.rotation_walk_rad_per_sqrt_rad = 0.03;
  for (const double rate_hz : {10.0, 50.0}) {  // whatever the rate
    options.rate_hz = rate_hz;
    const Spread spread = SpreadOverSeeds(options);
    EXPECT_NEAR(spread.sigma.x(), 0.02 * std::sqrt(16.0), 0.01);
    EXPECT_NEAR(spread.sigma.y(), 0.02 * std::sqrt(16.0), 0.01);
    EXPECT_NEAR(spread.sigma.z(), std::hypot(0.01 * std::sqrt(16.0), 0.03 * std::sqrt(4.0)), 0.01);
  }
}

TEST(PlanarOdometry, DoesNotDriftAtRest) {
  const PlanarMotion still(0, 10'000'000, Pose2(3.0, 1.0, 2.0), {Vector3d::Zero()});
  const auto samples = SimulateOdometry(still, {.rate_hz = 50.0}, 1);
  EXPECT_TRUE(samples.back().T_odom_body.Log().isZero(1e-6));
}

TEST(PlanarOdometry, RateZeroIsNone) { EXPECT_TRUE(SimulateOdometry(Arc(), {}, 1).empty()); }

TEST(PlanarOdometry, ValidateNamesTheField) {
  EXPECT_EQ(OdometryOptions{}.Validate(), "");
  EXPECT_EQ(OdometryOptions{.rate_hz = NAN}.Validate(), "rate_hz: must be in 0..1000");
  EXPECT_EQ(OdometryOptions{.rotation_scale_sigma = -1.0}.Validate(), "rotation_scale_sigma: must not be negative");
}

}  // namespace
}  // namespace lcmslam
