#include "simulation/planar_drive.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int64_t kStart = 5'000'000;
constexpr double kInterval_s = 0.01;

struct DriveCase {
  const char* world;
  PlanarDrive drive;
};

class DriveAroundTest : public testing::TestWithParam<DriveCase> {
 protected:
  const PlanarWorld world_ = *NamedPlanarWorld(GetParam().world);
  const PlanarDriveOptions options_{.drive = GetParam().drive};
};

TEST_P(DriveAroundTest, KeepsItsClearance) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const PlanarMotion motion = *DriveAround(world_, 60.0, kStart, options_, seed);
    for (int64_t utime = kStart; utime <= kStart + 60'000'000; utime += 10'000) {
      ASSERT_GE(world_.Distance(motion.PoseAt(utime).translation()), options_.clearance_m);
    }
  }
}

// Velocities and accelerations by differences of poses: nothing the driver says of itself.
TEST_P(DriveAroundTest, KeepsItsLimits) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const PlanarMotion motion = *DriveAround(world_, 60.0, kStart, options_, seed);
    Vector3d last = Vector3d::Zero();
    for (int i = 1; i <= 6000; ++i) {
      const Pose2 before = motion.PoseAt(kStart + (i - 1) * 10'000);
      const Pose2 after = motion.PoseAt(kStart + i * 10'000);
      const double yaw_rate = WrapAngle(after.yaw() - before.yaw()) / kInterval_s;
      const Vector2d velocity = (after.translation() - before.translation()) / kInterval_s;  // world axes
      ASSERT_LE(velocity.norm(), options_.max_speed_mps + 1e-9);
      ASSERT_LE(std::abs(yaw_rate), options_.max_yaw_rate_radps + 1e-9);
      ASSERT_LE(std::abs(yaw_rate - last.z()), options_.max_yaw_acceleration_radps2 * kInterval_s + 1e-9);
      // A differential robot's limit is on its speed; turning adds the centripetal acceleration.
      const double acceleration = options_.drive == PlanarDrive::kDifferential
                                      ? std::abs(velocity.norm() - last.head<2>().norm()) / kInterval_s
                                      : (velocity - last.head<2>()).norm() / kInterval_s;
      ASSERT_LE(acceleration, options_.max_acceleration_mps2 + 1e-3);
      last << velocity, yaw_rate;
    }
  }
}

TEST_P(DriveAroundTest, GetsAround) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const PlanarMotion motion = *DriveAround(world_, 60.0, kStart, options_, seed);
    double way_m = 0.0;
    int idle = 0;  // tenths of a second in a row
    int longest_idle = 0;
    for (int64_t utime = kStart; utime < kStart + 60'000'000; utime += 100'000) {
      way_m += (motion.PoseAt(utime + 100'000).translation() - motion.PoseAt(utime).translation()).norm();
      const Vector3d twist = motion.TwistAt(utime);
      idle = twist.head<2>().norm() < 0.01 && std::abs(twist.z()) < 0.01 ? idle + 1 : 0;
      longest_idle = std::max(longest_idle, idle);
    }
    EXPECT_GT(way_m, 6.0);
    EXPECT_LT(longest_idle, 15);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, DriveAroundTest,
    testing::Values(DriveCase{"room5", PlanarDrive::kDifferential}, DriveCase{"room5", PlanarDrive::kOmnidirectional},
                    DriveCase{"stdr10", PlanarDrive::kDifferential}, DriveCase{"mocap5", PlanarDrive::kOmnidirectional},
                    DriveCase{"corridor", PlanarDrive::kDifferential}),
    [](const auto& instance) {
      const bool differential = instance.param.drive == PlanarDrive::kDifferential;
      return std::string(instance.param.world) + (differential ? "Differential" : "Omnidirectional");
    });

TEST(DriveAround, DifferentialRobotsMoveAlongTheirHeading) {
  const PlanarMotion motion = *DriveAround(Room5World(), 20.0, 0, {}, 3);
  for (int64_t utime = 0; utime < 20'000'000; utime += 7'000) EXPECT_EQ(motion.TwistAt(utime).y(), 0.0);
}

TEST(DriveAround, StartsAtRest) {
  const PlanarMotion motion = *DriveAround(Room5World(), 1.0, kStart, {}, 3);
  EXPECT_TRUE(motion.TwistAt(kStart - 1).isZero());
  EXPECT_LE(motion.TwistAt(kStart).head<2>().norm(), 0.0101);
}

TEST(DriveAround, ZeroSpeedStandsStill) {
  const PlanarMotion motion = *DriveAround(Room5World(), 5.0, 0, {.max_speed_mps = 0.0, .max_yaw_rate_radps = 0.0}, 3);
  EXPECT_TRUE((motion.PoseAt(0).inverse() * motion.PoseAt(5'000'000)).Log().isZero());
}

TEST(DriveAround, NeedsFreeSpace) {
  EXPECT_FALSE(DriveAround(Room5World(), 60.0, 0, {.clearance_m = 2.0}, 1).has_value());
  EXPECT_FALSE(DriveAround(PlanarWorld({}), 60.0, 0, {}, 1).has_value());
}

TEST(PlanarMotion, IntegratesTwistsExactly) {
  // A quarter turn on a circle of 2 m radius, then straight on.
  const double quarter_s = 0.5;
  const Vector3d turn(std::numbers::pi / 2 * 2.0 / quarter_s, 0.0, std::numbers::pi / 2 / quarter_s);
  const PlanarMotion motion(1'000'000, 500'000, Pose2(1.0, 0.0, 0.0), {turn, Vector3d(1.0, 0.0, 0.0)});
  const auto expect_pose = [&](int64_t utime, const Pose2& expected) {
    EXPECT_TRUE((expected.inverse() * motion.PoseAt(utime)).Log().isZero(1e-12)) << utime;
  };
  expect_pose(0, Pose2(1.0, 0.0, 0.0));
  expect_pose(1'250'000, Pose2(1.0 + std::sqrt(2.0), 2.0 - std::sqrt(2.0), std::numbers::pi / 4));
  expect_pose(1'500'000, Pose2(3.0, 2.0, std::numbers::pi / 2));
  expect_pose(1'900'000, Pose2(3.0, 2.4, std::numbers::pi / 2));
  expect_pose(9'000'000, Pose2(3.0, 2.5, std::numbers::pi / 2));
  EXPECT_EQ(motion.end_utime(), 2'000'000);
  EXPECT_TRUE(motion.TwistAt(2'000'000).isZero());
}

}  // namespace
}  // namespace lcmslam
