#include "sensors/kitti.h"

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/input_file.h"
#include "support/as_bytes.h"
#include "support/error_of.h"
#include "support/real_data.h"

namespace lcmslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Kitti, DecodesPoints) {
  const float values[] = {1.0F, -2.0F, 3.0F, 0.5F, NAN, 0.0F, 0.0F, 0.25F};
  std::vector<uint8_t> bytes(sizeof values);
  std::memcpy(bytes.data(), values, sizeof values);
  const std::vector<SweepPoint> points = DecodeKittiPoints(bytes);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].y, -2.0F);
  EXPECT_EQ(points[0].intensity, 0.5F);
  EXPECT_EQ(points[0].ring, -1);
  EXPECT_FALSE(points[1].IsFinite());
  EXPECT_TRUE(DecodeKittiPoints({}).empty());
  bytes.pop_back();
  EXPECT_THAT(ErrorOf([&] { (void)DecodeKittiPoints(bytes); }), HasSubstr("31 bytes"));
}

TEST(Kitti, ParsesTimes) {
  EXPECT_THAT(ParseKittiTimes("0.000000e+00\n1.037359e-01\n\n 2.5 \r\n"), ElementsAre(0, 103'736, 2'500'000));
  EXPECT_TRUE(ParseKittiTimes("").empty());
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiTimes("1\nx\n"); }), HasSubstr("line 2: 'x' is not a number"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiTimes("1\n1 2\n"); }), HasSubstr("line 2: '2' is no date or time"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiTimes("nan\n"); }), HasSubstr("line 1: no time"));
}

TEST(Kitti, ParsesTimesOfRawDrives) {
  EXPECT_THAT(ParseKittiTimes("1970-01-02 00:00:01.5\n2011-09-26 13:02:25.951199337\n"),
              ElementsAre(86'401'500'000, 1'317'042'145'951'199));
  EXPECT_THAT(ParseKittiTimes("2012-02-29 23:59:60"), ElementsAre(1'330'560'000'000'000)) << "leap day, leap second";
  for (const char* bad : {"2011-02-29 00:00:00", "2011-13-01 00:00:00", "2011-09-26", "2011-09-26 13:02",
                          "-5-1-1 0:0:0", "2011-09-26 13:02:nan", "2011-09-26 13:02:25 1", "2011.5-01-01 00:00:00"}) {
    EXPECT_THAT(ErrorOf([&] { (void)ParseKittiTimes(bad); }), HasSubstr("line 1: ")) << bad;
  }
}

TEST(Kitti, ParsesPosesAndCalibration) {
  const std::vector<Pose3> poses = ParseKittiPoses("1 0 0 4 0 1 0 5 0 0 1 6\n0 -1.0001 0 1 1 0 0 2 0 0 1 3\n");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(Yaw(poses[1].rotation), M_PI / 2, 1e-4);
  EXPECT_NEAR(poses[1].rotation.norm(), 1.0, 1e-12);
  const Pose3 T_camera_lidar = ParseKittiCalibration("P0: 1 2 3\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n");
  EXPECT_LT((T_camera_lidar * Eigen::Vector3d(5, 0, 0) - Eigen::Vector3d(0.1, 0.2, 5.3)).norm(), 1e-9)
      << "the lidar's x is the camera's z";

  EXPECT_THAT(ErrorOf([] { (void)ParseKittiPoses("1 0 0\n"); }), HasSubstr("line 1: 3 numbers"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiPoses("2 0 0 4 0 1 0 5 0 0 1 6\n"); }), HasSubstr("no pose"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiPoses("1 0 0 4 0 1 0 5 0 0 -1 6\n"); }), HasSubstr("no pose"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiPoses("1 0 0 nan 0 1 0 5 0 0 1 6\n"); }), HasSubstr("no pose"));
  EXPECT_THAT(ErrorOf([] { (void)ParseKittiCalibration("P0: 1 2 3\n"); }), HasSubstr("no line 'Tr:'"));
}

TEST(Kitti, TimesRunClockwiseFromTheBack) {
  std::vector<SweepPoint> points(5);
  points[0].x = -1.0F, points[0].y = 1e-6F;   // back left: first
  points[1].y = 1.0F;                         // left
  points[2].x = 1.0F;                         // ahead
  points[3].y = -1.0F;                        // right
  points[4].x = -1.0F, points[4].y = -1e-6F;  // back right: last
  SetTimesByAzimuth(0.1, points);
  EXPECT_EQ(points[0].dt_us, -100'000);
  EXPECT_EQ(points[1].dt_us, -75'000);
  EXPECT_EQ(points[2].dt_us, -50'000);
  EXPECT_EQ(points[3].dt_us, -25'000);
  EXPECT_EQ(points[4].dt_us, 0);
}

TEST(Kitti, RealFiles) {
  const auto path = RealData("kitti_raw_0005/000000.bin");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const std::string bytes = ReadInput(path);
  const auto points = DecodeKittiPoints(AsBytes(bytes));
  EXPECT_EQ(points.size(), 123'398u);
  int in_range = 0;
  for (const SweepPoint& p : points) in_range += std::hypot(p.x, p.y, p.z) < 120.0F && p.intensity <= 1.0F ? 1 : 0;
  EXPECT_EQ(in_range, 123'398);

  EXPECT_EQ(ParseKittiPoses(ReadInput(RealData("hilti2021_uzh_run2/gt_lidar_kitti.txt"))).size(), 40u);
}

}  // namespace
}  // namespace lcmslam
