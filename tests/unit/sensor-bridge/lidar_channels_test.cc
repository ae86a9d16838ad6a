#include "sensor-bridge/lidar_channels.h"

#include <gtest/gtest.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

using Channels = std::map<std::string, std::string>;

TEST(LidarChannels, MostScansThenNameIsMain) {
  EXPECT_EQ(LidarChannels({{"/a/scan", 3}, {"/b/scan", 9}, {"/c-scan", 9}}, "", "none"),
            (Channels{{"/a/scan", "LIDAR_2D_A_SCAN"}, {"/b/scan", "LIDAR_2D"}, {"/c-scan", "LIDAR_2D_C_SCAN"}}));
}

TEST(LidarChannels, ChosenIsMain) {
  EXPECT_EQ(LidarChannels({{"FRONT", 3}, {"BACK", 9}}, "FRONT", "none"),
            (Channels{{"FRONT", "LIDAR_2D"}, {"BACK", "LIDAR_2D_BACK"}}));
  EXPECT_THROW(LidarChannels({{"FRONT", 3}}, "REAR", "none"), CommandError);
  EXPECT_THROW(LidarChannels({}, "", "none"), CommandError);
}

TEST(LidarChannels, OtherKindsHaveTheirOwn) {
  EXPECT_EQ(SensorChannels({{"/os/points", 5}, {"/map", 1}}, "", "LIDAR_3D"),
            (Channels{{"/os/points", "LIDAR_3D"}, {"/map", "LIDAR_3D_MAP"}}));
  EXPECT_TRUE(SensorChannels({}, "", "IMU").empty());
  EXPECT_THROW(SensorChannels({}, "/imu", "IMU"), CommandError);
}

TEST(LidarChannels, NamesFitLcm) {
  const std::string longest(200, 'x');
  const auto channels = LidarChannels({{longest, 1}, {"main", 2}}, "", "none");
  EXPECT_LE((channels.at(longest) + "_EXTRINSICS").size(), 63U);
}

}  // namespace
}  // namespace lcmslam
