#include "sensors/ros_messages.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "support/as_bytes.h"
#include "support/ros_bytes.h"

namespace lcmslam {
namespace {

RosLaserScan Scan(float time_increment_s, const std::vector<float>& ranges_m) {
  return DecodeRosLaserScan(AsBytes(RosLaserScanBytes(5'000'000, "/laser", -1.0F, 0.5F, time_increment_s, ranges_m)));
}

TEST(RosMessages, LaserScanIsStampedWithItsLastBeam) {
  const RosLaserScan scan = Scan(0.01F, {1, 2, 3});
  EXPECT_EQ(scan.utime, 5'000'000);
  EXPECT_EQ(scan.frame, "laser");
  const PlanarScan planar = ToPlanarScan(scan, false);
  EXPECT_EQ(planar.utime, 5'020'000);
  ASSERT_EQ(planar.beams.size(), 3U);
  EXPECT_EQ(planar.beams[0].dt_us, -20'000);
  EXPECT_EQ(planar.beams[2].dt_us, 0);
  EXPECT_EQ(planar.beams[2].angle_rad, 0.0F);
  EXPECT_EQ(planar.beams[2].range_m, 3.0F);
}

TEST(RosMessages, UnknownBeamTimesAreEqual) {
  for (const float time_increment_s : {0.0F, -0.01F, NAN, INFINITY, 1e6F}) {
    const PlanarScan planar = ToPlanarScan(Scan(time_increment_s, {1, 2, 3}), false);
    EXPECT_EQ(planar.utime, 5'000'000);
    EXPECT_EQ(planar.beams[0].dt_us, 0);
  }
  EXPECT_EQ(ToPlanarScan(Scan(0.01F, {}), false).utime, 5'000'000);
}

TEST(RosMessages, RangesOutsideTheLimitsAreNoReturns) {
  const PlanarScan planar = ToPlanarScan(Scan(0.0F, {0.04F, 0.05F, 20.0F, 20.1F, NAN, INFINITY, -1.0F}), false);
  for (size_t i = 0; i < planar.beams.size(); ++i) EXPECT_EQ(planar.beams[i].HasReturn(), i == 1 || i == 2) << i;
}

// The same points in the body, seen from above, whether read through the scan or through its mirror.
TEST(RosMessages, UpsideDownLidarComesOutCounterClockwise) {
  const RosLaserScan scan = Scan(0.01F, {1, 2, 3, 4, 5});
  const PlanarScan as_is = ToPlanarScan(scan, false), from_above = ToPlanarScan(scan, true);
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  for (size_t i = 0; i < as_is.beams.size(); ++i) {
    const auto point = [](const Beam& b) {
      return Eigen::Vector3d(b.range_m * std::cos(b.angle_rad), b.range_m * std::sin(b.angle_rad), 0);
    };
    EXPECT_LT((roll * point(as_is.beams[i]) - point(from_above.beams[i])).norm(), 1e-6);
    EXPECT_EQ(as_is.beams[i].dt_us, from_above.beams[i].dt_us);
  }
}

TEST(RosMessages, PosesOfEveryType) {
  const Pose3 pose{{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()))};
  const std::string stamped = RosPoseStampedBytes(7'000'001, pose);
  const std::string odometry = RosOdometryBytes(7'000'001, "/base_link", pose);
  const std::string transform = RosTransformBytes(7'000'001, "/odom", "/base_link", pose).substr(4);
  for (const auto& [type, bytes, child] :
       {std::tuple{"geometry_msgs/PoseStamped", stamped, ""},
        {"geometry_msgs/PoseWithCovarianceStamped", stamped + std::string(36 * 8, '\0'), ""},
        {"nav_msgs/Odometry", odometry, "base_link"},
        {"geometry_msgs/TransformStamped", transform, "base_link"}}) {
    SCOPED_TRACE(type);
    EXPECT_TRUE(IsRosPoseType(type));
    const RosPose decoded = DecodeRosPose(type, AsBytes(bytes));
    EXPECT_EQ(decoded.utime, 7'000'001);
    EXPECT_EQ(decoded.child_frame, child);
    EXPECT_EQ(decoded.T_frame_child.translation, pose.translation);
    EXPECT_EQ(decoded.T_frame_child.rotation.coeffs(), pose.rotation.coeffs());
    EXPECT_THROW((void)DecodeRosPose(type, AsBytes(bytes + "x")), BadInput);
    EXPECT_THROW((void)DecodeRosPose(type, AsBytes(bytes.substr(1))), BadInput);
  }
  EXPECT_FALSE(IsRosPoseType("geometry_msgs/Pose"));
}

TEST(RosMessages, Transforms) {
  const std::string one = RosTransformBytes(1, "base", "laser", {});
  const auto transforms = DecodeRosTransforms(AsBytes(one));
  ASSERT_EQ(transforms.size(), 1U);
  EXPECT_EQ(transforms[0].frame, "base");
  EXPECT_EQ(transforms[0].child_frame, "laser");
  EXPECT_TRUE(DecodeRosTransforms(AsBytes(std::string(4, '\0'))).empty());
  EXPECT_THROW((void)DecodeRosTransforms(AsBytes(std::string(4, '\xff'))), BadInput);
}

TEST(RosMessages, MutatedBytesAreRefusedOrRead) {
  const std::string good = RosLaserScanBytes(5'000'000, "laser", -1.0F, 0.5F, 0.01F, std::vector<float>(50, 1.0F));
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = good;
    bytes[random() % bytes.size()] = static_cast<char>(random());
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    try {
      const PlanarScan scan = ToPlanarScan(DecodeRosLaserScan(AsBytes(bytes)), false);
      EXPECT_LE(scan.beams.size(), 100U);
    } catch (const BadInput&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace lcmslam
