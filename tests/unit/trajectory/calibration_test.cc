#include "trajectory/calibration.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

const double kTimeOffset_s = 0.037;
const Pose3 kMarker{{0.12, -0.05, 0.30}, testing::RotationVector({0.2, -0.1, 2.5})};

struct Episode {
  Trajectory estimate, reference;
};

// 60 s in which the reference's clock is kTimeOffset_s ahead of the estimate's.
Episode Record(Pose3 (*motion)(double), const Pose3& T_world_map, double noise_m, double noise_rad,
               double reference_period_s, uint64_t seed) {
  testing::Noise noise(seed);
  const auto disturb = [&](Pose3 pose) {
    pose.translation += noise.Gauss3(noise_m);
    pose.rotation = (pose.rotation * testing::RotationVector(noise.Gauss3(noise_rad))).normalized();
    return pose;
  };
  Episode episode;
  episode.estimate = testing::Sample([&](double t_s) { return motion(t_s); }, 60.0, 0.1);
  episode.reference =
      testing::Sample([&](double t_s) { return disturb(T_world_map * motion(t_s - kTimeOffset_s) * kMarker); }, 60.0,
                      reference_period_s);
  return episode;
}

Pose3 StraightAndLevel(double t_s) { return ToPose3({0.4 * t_s + 0.3 * std::sin(t_s), 0.0, 0.0}); }
Pose3 Circle(double t_s) { return ToPose3({2.0 * std::cos(0.25 * t_s), 2.0 * std::sin(0.25 * t_s), 0.25 * t_s}); }
Pose3 Still(double) { return {}; }

const Pose3 kSpatialMap{{3.0, -1.0, 0.7}, testing::RotationVector({0.3, 0.2, 2.0})};
const Pose3 kPlanarMap = ToPose3({3.0, -1.0, 2.0});

void ExpectRecovered(const Calibration& c, const Pose3& T_world_map) {
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_THAT(c.unexcited, IsEmpty());
  EXPECT_NEAR(c.time_offset_s, kTimeOffset_s, 0.001);
  EXPECT_LT((c.T_body_marker.translation - kMarker.translation).norm(), 0.002);
  EXPECT_LT(AngleBetween(c.T_body_marker.rotation, kMarker.rotation), 0.003);
  EXPECT_LT(AngleBetween(c.T_world_map.rotation, T_world_map.rotation), 0.003);
}

TEST(Calibrate, RecoversOffsetAndLeverArmIn3D) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    for (const double period_s : {0.01, 0.04, 0.1}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", period " << period_s << " s");
      const Episode e = Record(testing::Flight, kSpatialMap, 0.005, 0.005, period_s, seed);
      ExpectRecovered(Calibrate(e.estimate, e.reference), kSpatialMap);
    }
  }
}

TEST(Calibrate, RecoversOffsetAndLeverArmOfAPlanarRunWhoseFramesShareTheFloor) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    for (const double period_s : {0.01, 0.1}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", period " << period_s << " s");
      const Episode e = Record(testing::Drive, kPlanarMap, 0.005, 0.005, period_s, seed);
      ExpectRecovered(Calibrate(e.estimate, e.reference, {.alignment = AlignmentKind::kSe2}), kPlanarMap);
    }
  }
}

TEST(Calibrate, PerfectDataIsRecoveredClosely) {
  const Episode e = Record(testing::Flight, kSpatialMap, 0.0, 0.0, 0.01, 0);
  const Calibration c = Calibrate(e.estimate, e.reference);
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_NEAR(c.time_offset_s, kTimeOffset_s, 1e-5);
  EXPECT_LT((c.T_body_marker.translation - kMarker.translation).norm(), 1e-4);
}

TEST(Calibrate, LargeOffsetsAndGlitchesAreFound) {
  Episode e = Record(testing::Flight, kSpatialMap, 0.005, 0.005, 0.02, 3);
  for (StampedPose& p : e.reference) p.utime -= 800'000;
  for (size_t i = 500; i < 600; ++i) e.reference[i].pose.translation.y() += 2.0;
  const Calibration c = Calibrate(e.estimate, e.reference);
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_NEAR(c.time_offset_s, kTimeOffset_s - 0.8, 0.002);
  EXPECT_LT((c.T_body_marker.translation - kMarker.translation).norm(), 0.005);
}

// Over many seeds the errors are as large as the standard deviations say.
TEST(Calibrate, StandardDeviationsAreHonest) {
  constexpr int kSeeds = 30;
  double time_squares = 0.0, arm_squares = 0.0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    Episode e = Record(testing::Flight, kSpatialMap, 0.0, 0.0, 0.01, seed);
    testing::Noise noise(seed + 1000);
    for (StampedPose& p : e.estimate) {  // independent from one residual to the next, as the deviations suppose
      p.pose.translation += noise.Gauss3(0.005);
      p.pose.rotation = (p.pose.rotation * testing::RotationVector(noise.Gauss3(0.005))).normalized();
    }
    const Calibration c = Calibrate(e.estimate, e.reference);
    ASSERT_EQ(c.status, CalibrationStatus::kOk);
    const Eigen::Vector3d arm_error = c.T_body_marker.translation - kMarker.translation;
    time_squares += std::pow((c.time_offset_s - kTimeOffset_s) / c.time_offset_sd_s, 2) / kSeeds;
    arm_squares += arm_error.cwiseQuotient(c.lever_arm_sd_m).squaredNorm() / (3 * kSeeds);
    EXPECT_NEAR(c.position_sigma_m, 0.005, 0.001);
  }
  EXPECT_NEAR(std::sqrt(time_squares), 1.0, 0.35);
  EXPECT_NEAR(std::sqrt(arm_squares), 1.0, 0.25);
}

TEST(Calibrate, PlanarRunInFramesOfUnknownHeightSaysSo) {
  const Episode e = Record(testing::Drive, kSpatialMap, 0.005, 0.005, 0.02, 1);
  const Calibration c = Calibrate(e.estimate, e.reference, {.alignment = AlignmentKind::kSe3});
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_THAT(c.unexcited, ElementsAre("lever arm z"));
  EXPECT_EQ(c.T_body_marker.translation.z(), 0.0);
  EXPECT_LT((c.T_body_marker.translation - kMarker.translation).head<2>().norm(), 0.002);
  EXPECT_NEAR(c.time_offset_s, kTimeOffset_s, 0.001);
}

TEST(Calibrate, WithoutTurningTheLeverArmIsNotExcited) {
  const Episode e = Record(StraightAndLevel, kPlanarMap, 0.005, 0.005, 0.02, 1);
  const Calibration c = Calibrate(e.estimate, e.reference, {.alignment = AlignmentKind::kSe2});
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_THAT(c.unexcited, IsSupersetOf({"lever arm x", "lever arm y"}));
  EXPECT_TRUE(std::isinf(c.lever_arm_sd_m.x()));
  EXPECT_NEAR(c.time_offset_s, kTimeOffset_s, 0.002);
}

// On a circle at constant speed a later clock looks like a turned frame.
TEST(Calibrate, CircleDoesNotExciteTheTimeOffset) {
  const Episode e = Record(Circle, kPlanarMap, 0.002, 0.002, 0.02, 1);
  const Calibration c = Calibrate(e.estimate, e.reference, {.alignment = AlignmentKind::kSe2});
  ASSERT_EQ(c.status, CalibrationStatus::kOk);
  EXPECT_THAT(c.unexcited, Contains("time offset"));
  EXPECT_EQ(c.time_offset_s, 0.0);
}

TEST(Calibrate, StandingStillExcitesNothing) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    for (const double period_s : {0.01, 0.1}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", period " << period_s << " s");
      const Episode e = Record(Still, kPlanarMap, 0.005, 0.005, period_s, seed);
      const Calibration c = Calibrate(e.estimate, e.reference, {.alignment = AlignmentKind::kSe3});
      ASSERT_EQ(c.status, CalibrationStatus::kOk);
      EXPECT_THAT(c.unexcited, IsSupersetOf({"time offset", "lever arm x", "lever arm y", "lever arm z"}));
      EXPECT_EQ(c.time_offset_s, 0.0);
    }
  }
}

TEST(Calibrate, TooLittleToGoBy) {
  const Episode e = Record(testing::Flight, kSpatialMap, 0.0, 0.0, 0.02, 1);
  EXPECT_EQ(Calibrate({}, e.reference).status, CalibrationStatus::kTooFewPairs);
  EXPECT_EQ(Calibrate(e.estimate, {}).status, CalibrationStatus::kTooFewPairs);
  EXPECT_EQ(Calibrate({e.estimate.data(), 5}, e.reference).status, CalibrationStatus::kTooFewPairs);
  EXPECT_NE(CalibrationOptions{.alignment = AlignmentKind::kFirst}.Validate(), "");
  EXPECT_EQ(CalibrationOptions{}.Validate(), "");
}

}  // namespace
}  // namespace lcmslam
