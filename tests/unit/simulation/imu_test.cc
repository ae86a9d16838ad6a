#include "simulation/imu.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/pose3.h"
#include "simulation/spatial_carrier.h"
#include "simulation/spatial_worlds.h"

namespace lcmslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int64_t kStart_us = 5'000'000;

ImuOptions Exact(double rate_hz) {
  return {.rate_hz = rate_hz,
          .gyroscope_noise_radps_per_sqrt_hz = 0.0,
          .gyroscope_bias_sigma_radps = 0.0,
          .gyroscope_walk_radps2_per_sqrt_hz = 0.0,
          .accelerometer_noise_mps2_per_sqrt_hz = 0.0,
          .accelerometer_bias_sigma_mps2 = 0.0,
          .accelerometer_walk_mps3_per_sqrt_hz = 0.0};
}

SpatialMotion Journey() { return *CarryAround(BareRoomWorld(), 20.0, {}, 4); }

SpatialMotion Still() {
  MotionVector c;
  c << 0.0, 0.0, 0.0, 1.0, 0.3, -0.2;
  return SpatialMotion(100.0, std::vector<MotionVector>(4, c));
}

// Strapdown integration by the trapezoid rule.
BodyState Integrate(BodyState body, const std::vector<ImuSample>& samples) {
  Pose3& T = body.T_world_body;
  for (size_t i = 1; i < samples.size(); ++i) {
    const double dt_s = 1e-6 * static_cast<double>(samples[i].utime - samples[i - 1].utime);
    const Vector3d turn = 0.5 * dt_s * (samples[i - 1].angular_velocity_radps + samples[i].angular_velocity_radps);
    const Quaterniond before = T.rotation;
    if (turn.norm() > 0.0) T.rotation = T.rotation * Quaterniond(AngleAxisd(turn.norm(), turn.normalized()));
    const Vector3d force =
        0.5 * (before * samples[i - 1].specific_force_mps2 + T.rotation * samples[i].specific_force_mps2);
    const Vector3d acceleration = force - kGravity_mps2 * Vector3d::UnitZ();
    T.translation += dt_s * body.velocity_mps + 0.5 * dt_s * dt_s * acceleration;
    body.velocity_mps += dt_s * acceleration;
  }
  return body;
}

TEST(SimulateImu, IntegratesBackToTheTrajectory) {
  const SpatialMotion motion = Journey();
  const std::vector<ImuSample> samples = SimulateImu(motion, kStart_us, Exact(1000.0), 1);
  const BodyState end = Integrate(motion.StateAt(0.0), samples);
  const BodyState truth = motion.StateAt(1e-6 * static_cast<double>(samples.back().utime - kStart_us));
  EXPECT_GT((truth.T_world_body.translation - motion.PoseAt(0.0).translation).norm(), 0.5) << "it went somewhere";
  EXPECT_LT(AngleBetween(end.T_world_body.rotation, truth.T_world_body.rotation), 1e-5);
  EXPECT_LT((end.velocity_mps - truth.velocity_mps).norm(), 1e-3);
  EXPECT_LT((end.T_world_body.translation - truth.T_world_body.translation).norm(), 5e-3);
}

TEST(SimulateImu, FeelsItsWeightAtRest) {
  const SpatialMotion motion = Still();
  for (const ImuSample& sample : SimulateImu(motion, 0, Exact(10.0), 1)) {
    const Vector3d up = motion.PoseAt(0.0).rotation * sample.specific_force_mps2;
    ASSERT_LT((up - kGravity_mps2 * Vector3d::UnitZ()).norm(), 1e-12);
    ASSERT_LT(sample.angular_velocity_radps.norm(), 1e-12);
  }
}

TEST(SimulateImu, StampsFollowTheRate) {
  const std::vector<ImuSample> samples = SimulateImu(Still(), kStart_us, Exact(300.0), 1);
  ASSERT_EQ(samples.size(), 30'001u);
  EXPECT_EQ(samples[0].utime, kStart_us);
  EXPECT_EQ(samples[1].utime, kStart_us + 3333);
  EXPECT_EQ(samples[3].utime, kStart_us + 10'000);
  EXPECT_TRUE(SimulateImu(Still(), kStart_us, Exact(0.0), 1).empty());
}

// White noise: standard deviation density * sqrt(rate). Bias: one draw per axis; over many seeds its spread is sigma.
// Walk: the spread of the bias after T seconds is walk * sqrt(T).
TEST(SimulateImu, NoiseAndBiasAsTheirDensitiesSay) {
  ImuOptions white = Exact(100.0);
  white.gyroscope_noise_radps_per_sqrt_hz = 1e-3;
  double squares = 0.0;
  const std::vector<ImuSample> samples = SimulateImu(Still(), 0, white, 1);
  for (const ImuSample& sample : samples) squares += sample.angular_velocity_radps.squaredNorm() / 3.0;
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(samples.size())), 1e-2, 2e-4);

  ImuOptions biased = Exact(1.0);
  biased.gyroscope_bias_sigma_radps = 0.01;
  biased.gyroscope_walk_radps2_per_sqrt_hz = 0.002;
  double at_start = 0.0, at_end = 0.0;
  constexpr int kSeeds = 400;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<ImuSample> walk = SimulateImu(Still(), 0, biased, seed);
    at_start += walk.front().angular_velocity_radps.squaredNorm() / 3.0 / kSeeds;
    at_end += walk.back().angular_velocity_radps.squaredNorm() / 3.0 / kSeeds;
  }
  EXPECT_NEAR(std::sqrt(at_start), 0.01, 0.001);
  EXPECT_NEAR(std::sqrt(at_end), std::hypot(0.01, 0.002 * std::sqrt(100.0)), 0.002);
}

TEST(ImuOptions, NamesTheWrongField) {
  EXPECT_EQ(ImuOptions{}.Validate(), "");
  EXPECT_EQ(ImuOptions{.rate_hz = NAN}.Validate(), "rate_hz: must be in 0..1000");
  EXPECT_EQ(ImuOptions{.accelerometer_bias_sigma_mps2 = -1.0}.Validate(),
            "accelerometer_bias_sigma_mps2: must not be negative");
}

}  // namespace
}  // namespace lcmslam
