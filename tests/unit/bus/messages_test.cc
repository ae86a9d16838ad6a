#include "bus/messages.h"

#include <cmath>

#include <gtest/gtest.h>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>

namespace lcmslam {
namespace {

TEST(Messages, ScanGoesThroughTheWire) {
  const PlanarScan scan{5'000'000, {{1.5F, -0.1F, -2000}, {NAN, 0.0F, -1000}, {2.5F, 0.1F, 0}}};
  const auto back = DecodeScan(Encode(ToMessage(scan)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->utime, scan.utime);
  ASSERT_EQ(back->beams.size(), 3U);
  EXPECT_EQ(back->beams[0].range_m, 1.5F);
  EXPECT_EQ(back->beams[0].angle_rad, -0.1F);
  EXPECT_EQ(back->beams[0].dt_us, -2000);
  EXPECT_FALSE(back->beams[1].HasReturn());
}

TEST(Messages, ScanStampIsItsLastBeam) {
  planar_scan_t message{};
  message.utime = 1000;  // some drivers stamp the first beam
  message.num_ranges = 2;
  message.ranges = message.thetas = message.intensities = {1.0F, 1.0F};
  message.times = {1000, 51'000};
  const auto scan = DecodeScan(Encode(message));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->utime, 51'000);
  EXPECT_EQ(scan->beams[0].dt_us, -50'000);
}

TEST(Messages, ScanAnglesComeOutCounterClockwise) {
  planar_scan_t message{};  // one turn of an RPLidar on an MBot
  message.utime = 1'000'000;
  message.num_ranges = 300;
  for (int i = 0; i < message.num_ranges; ++i) {
    message.ranges.push_back(1.0F);
    message.thetas.push_back(0.02F * static_cast<float>(i));
    message.times.push_back(message.utime + 500 * i);
    message.intensities.push_back(0.0F);
  }
  const auto angle = [&](std::optional<AngleSense> sense) {
    return DecodeScan(Encode(message), sense)->beams[50].angle_rad;
  };
  EXPECT_EQ(angle({}), -1.0F);
  EXPECT_EQ(angle(AngleSense::kClockwise), -1.0F);
  EXPECT_EQ(angle(AngleSense::kCounterClockwise), 1.0F);
  message.utime = message.times.back();  // stamped as ours
  EXPECT_EQ(angle({}), 1.0F);
}

TEST(Messages, BeamTimesThatAreNoneAreUnknown) {
  planar_scan_t message{};
  message.utime = 1'700'000'000'000'000;
  message.num_ranges = 2;
  message.ranges = message.thetas = message.intensities = {1.0F, 1.0F};
  for (const int64_t time : {int64_t{0}, INT64_MIN, INT64_MAX}) {
    message.times = {time, time};
    const auto scan = DecodeScan(Encode(message));
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->utime, message.utime);
    EXPECT_EQ(scan->beams[0].dt_us, 0);
  }
}

TEST(Messages, BotCoreScanIsRecognized) {
  planar_lidar_t message{};
  message.utime = 7;
  message.nranges = 3;
  message.ranges = {1.0F, 2.0F, 3.0F};
  message.rad0 = -1.0F;
  message.radstep = 0.5F;
  const std::vector<uint8_t> bytes = Encode(message);
  EXPECT_TRUE(IsScan(bytes));
  EXPECT_FALSE(IsPose(bytes));
  const auto scan = DecodeScan(bytes);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->beams[2].angle_rad, 0.0F);
  EXPECT_EQ(scan->beams[2].range_m, 3.0F);
}

TEST(Messages, PosesOfBothKinds) {
  const StampedPose pose{9, {{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY()))}};
  const auto back = DecodePose(Encode(ToMessage(pose)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->utime, 9);
  EXPECT_LT((back->pose.translation - pose.pose.translation).norm(), 1e-15);
  EXPECT_LT(AngleBetween(back->pose.rotation, pose.pose.rotation), 1e-12);

  pose_xyt_t planar{};
  planar.x = 0.5F;
  planar.theta = 1.5F;
  const auto from_planar = DecodePose(Encode(planar));
  ASSERT_TRUE(from_planar);
  EXPECT_EQ(from_planar->pose.translation.x(), 0.5);
  EXPECT_NEAR(Yaw(from_planar->pose.rotation), 1.5, 1e-6);
}

TEST(Messages, APoseThatIsNoneIsRefused) {
  pose_t message{};  // quaternion of length 0
  EXPECT_FALSE(DecodePose(Encode(message)));
  message.orientation[0] = 1.0;
  EXPECT_TRUE(DecodePose(Encode(message)));
  message.pos[1] = NAN;
  EXPECT_FALSE(DecodePose(Encode(message)));
}

TEST(Messages, Extrinsics) {
  const Pose3 T_body_sensor{{0.1, -0.2, 0.3}, Eigen::Quaterniond(Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()))};
  const auto back = DecodeExtrinsics(Encode(ExtrinsicsMessage(1, T_body_sensor)));
  ASSERT_TRUE(back);
  EXPECT_LT((T_body_sensor.inverse() * *back).translation.norm(), 1e-12);
}

}  // namespace
}  // namespace lcmslam
