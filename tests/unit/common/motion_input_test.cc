#include "common/motion_input.h"

#include <limits>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

Eigen::Quaterniond Turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

const Pose3 kMounting{{0.3, -0.1, 0.5}, Turn(0.7, {1, 2, 3})};

TEST(MotionInput, KnowsNothingAtFirst) {
  const MotionInput motion;
  EXPECT_FALSE(motion.Between(0, 100'000).rotation);
  EXPECT_FALSE(motion.Between(0, 100'000).odometry);
}

// A body on a circle with odometry every 20 ms: the lidar's motion is T_lidar_body T_from^-1 T_to T_body_lidar.
TEST(MotionInput, MovesOdometryToTheLidar) {
  const auto body_at = [](double t_s) {
    return Pose3{{std::cos(t_s), std::sin(t_s), 0.1 * t_s}, Turn(t_s, Eigen::Vector3d::UnitZ())};
  };
  MotionInput motion;
  motion.SetMounting(kMounting);
  for (int64_t t = 0; t <= 500'000; t += 20'000) motion.AddOdometry({t, body_at(1e-6 * static_cast<double>(t))});
  for (const int64_t to : {int64_t{300'000}, int64_t{333'000}, int64_t{510'000}}) {
    const auto odometry = motion.Between(200'000, to).odometry;
    ASSERT_TRUE(odometry);
    const Pose3 want = (body_at(0.2) * kMounting).inverse() * (body_at(1e-6 * static_cast<double>(to)) * kMounting);
    EXPECT_LT((odometry->translation - want.translation).norm(), 3e-4) << to;
    EXPECT_LT(AngleBetween(odometry->rotation, want.rotation), 1e-9) << to;
  }
  EXPECT_FALSE(motion.Between(200'000, 600'000).odometry) << "too far beyond the last";
  EXPECT_FALSE(motion.Between(-1, 300'000).odometry) << "before the first";
}

// Turning about one fixed axis of the body, the lidar turns about the same axis in its own frame.
TEST(MotionInput, IntegratesTheGyroscope) {
  const Eigen::Vector3d rate(0.3, -0.5, 1.1);
  MotionInput motion;
  motion.SetMounting(kMounting);
  for (int64_t t = 0; t <= 300'000; t += 5'000) motion.AddImu({t, rate, {}});
  const auto rotation = motion.Between(102'000, 301'000).rotation;
  ASSERT_TRUE(rotation);
  const Eigen::Vector3d axis = kMounting.rotation.conjugate() * rate;
  EXPECT_LT(AngleBetween(*rotation, Turn(0.199 * rate.norm(), axis)), 1e-9);
  EXPECT_FALSE(motion.Between(102'000, 400'000).rotation) << "the last reading is too old";
  EXPECT_FALSE(motion.Between(-1, 100'000).rotation) << "before the first";
}

TEST(MotionInput, LeavesOutWhatHasHoles) {
  MotionInput motion;
  for (const int64_t t : {0, 10'000, 90'000, 100'000}) motion.AddImu({t, Eigen::Vector3d::UnitX(), {}});
  EXPECT_FALSE(motion.Between(5'000, 95'000).rotation);
  EXPECT_TRUE(motion.Between(91'000, 99'000).rotation);
}

TEST(MotionInput, StampsFromOutsideDoNoHarm) {
  MotionInput motion;
  for (const int64_t t : {std::numeric_limits<int64_t>::max(), int64_t{0}, std::numeric_limits<int64_t>::min(),
                          int64_t{0}, int64_t{0}, int64_t{-5}, int64_t{10'000}, int64_t{20'000}}) {
    motion.AddOdometry({t, {}});
    motion.AddImu({t, Eigen::Vector3d::UnitX(), {}});
  }
  EXPECT_TRUE(motion.Between(0, 20'000).rotation) << "started afresh";
  EXPECT_TRUE(motion.Between(0, 20'000).odometry);
  EXPECT_FALSE(motion.Between(std::numeric_limits<int64_t>::min(), std::numeric_limits<int64_t>::max()).rotation);
}

}  // namespace
}  // namespace lcmslam
