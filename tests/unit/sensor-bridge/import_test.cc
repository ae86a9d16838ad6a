// `sensor-bridge import` from the command line to the log it writes.

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "geometry/angles.h"
#include "support/real_data.h"
#include "support/rosbag_builder.h"
#include "support/temporary_file.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

using testing::ElementsAre;

Pose2 PoseOn(const Imported& log, const std::string& channel, size_t i = 0) {
  return ToPose2(DecodePose(log.On(channel).at(i).data).value().pose);
}

Imported ImportText(const std::string& text, const std::vector<std::string>& options = {}) {
  const TemporaryFile file(text);
  return Imported("carmen", file.path(), options);
}

Imported ImportBag(const std::string& bytes, const std::vector<std::string>& options = {}) {
  const TemporaryFile file(bytes);
  return Imported("rosbag", file.path(), options);
}

constexpr const char* kFlaser = "FLASER 3 1 2 3 0.5 0 0 0.5 0 0 1.10 host 1\n";

TEST(ImportCarmen, OdometryComesBeforeItsScanAndStampsRise) {
  const Imported log = ImportText("PARAM robot_frontlaser_offset 0.1\n" + std::string(kFlaser) +
                                  "ODOM 0 0 0 0 0 0 1.00 host 1\nODOM 1 0 0.2 0 0 0 1.20 host 1\n");
  EXPECT_EQ(log.exit_code, 0);
  EXPECT_THAT(log.Channels(), ElementsAre("ODOMETRY", "ODOMETRY", "LIDAR_2D_EXTRINSICS", "LIDAR_2D", "ODOMETRY"));
  EXPECT_EQ(log.events[3].utime, 1'100'000);
  EXPECT_NEAR(PoseOn(log, "ODOMETRY", 1).x(), 0.5, 1e-9);
  EXPECT_NEAR(PoseOn(log, "ODOMETRY", 1).yaw(), 0.1, 1e-9) << "between the ODOM lines, not the copy in the FLASER line";
  const auto mounting = DecodeExtrinsics(log.events[2].data);
  ASSERT_TRUE(mounting);
  EXPECT_EQ(mounting->translation.x(), 0.1);
}

TEST(ImportCarmen, WithoutOdomLinesTheScanBringsItsOdometry) {
  const Imported log = ImportText(kFlaser);
  EXPECT_THAT(log.Channels(), ElementsAre("ODOMETRY", "LIDAR_2D_EXTRINSICS", "LIDAR_2D"));
  EXPECT_EQ(PoseOn(log, "ODOMETRY").x(), 0.5);
}

TEST(ImportCarmen, ScanDelayMovesOdometryNotScans) {
  const Imported log = ImportText(std::string(kFlaser) + "ODOM 0 0 0 0 0 0 1.00 host 1\nODOM 1 0 0 0 0 0 1.20 host 1\n",
                                  {"--scan-delay", "0.05"});
  EXPECT_EQ(log.On("LIDAR_2D")[0].utime, 1'100'000);
  EXPECT_EQ(log.On("ODOMETRY")[0].utime, 1'050'000);
  EXPECT_NEAR(PoseOn(log, "ODOMETRY", 1).x(), 0.25, 1e-9) << "the odometry of 1.05 s";
}

TEST(ImportCarmen, MountingsComeOnceASecond) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += fmt::format("FLASER 1 1 0 0 0 0 0 0 {:.1f} host 1\n", 5.0 + 0.1 * i);
  EXPECT_EQ(ImportText(text).On("LIDAR_2D_EXTRINSICS").size(), 5U);
}

TEST(ImportCarmen, WhatCameBeforeAMalformedLineIsKept) {
  const Imported log = ImportText(std::string(kFlaser) + "FLASER 3 1 2\n");
  EXPECT_EQ(log.exit_code, 3);
  EXPECT_EQ(log.On("LIDAR_2D").size(), 1U);
  EXPECT_EQ(ImportText("# no scans\n").exit_code, 3);
  EXPECT_EQ(ImportText("").exit_code, 3);
}

constexpr const char* kScanType = "sensor_msgs/LaserScan";

std::string ScanBytes(int64_t utime, const std::string& frame) {
  return RosLaserScanBytes(utime, frame, -0.5F, 0.5F, 0.01F, {1.0F, 2.0F, 3.0F});
}

TEST(ImportRosbag, UpsideDownLidarIsSeenFromAbove) {
  const Pose3 mounted{{0.3, 0, 0.2}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()))};
  const Imported log =
      ImportBag(RosbagBuilder()
                    .Message("/tf", "tf2_msgs/TFMessage", 1, RosTransformBytes(1, "base_link", "laser", mounted))
                    .Message("/scan", kScanType, 1'000'000, ScanBytes(1'000'000, "laser"))
                    .Bytes());
  EXPECT_EQ(log.exit_code, 0);
  EXPECT_THAT(log.Channels(), ElementsAre("LIDAR_2D_EXTRINSICS", "LIDAR_2D"));
  const PlanarScan scan = DecodeScan(log.events[1].data).value();
  EXPECT_EQ(scan.utime, 1'020'000);
  EXPECT_EQ(scan.beams[0].angle_rad, 0.5F);
  const Pose3 T_body_sensor = DecodeExtrinsics(log.events[0].data).value();
  EXPECT_LT(AngleBetween(T_body_sensor.rotation, Eigen::Quaterniond::Identity()), 1e-9);
  EXPECT_LT((T_body_sensor.translation - mounted.translation).norm(), 1e-12);
}

std::string TwoLidarBag() {
  RosbagBuilder bag("lz4");
  bag.Message("/tf_static", "tf2_msgs/TFMessage", 1,
              RosTransformBytes(1, "/base_footprint", "/base_link", {{0, 0, 0.1}, Eigen::Quaterniond::Identity()}));
  bag.Message("/tf_static", "tf2_msgs/TFMessage", 1, RosTransformBytes(1, "base_link", "front", ToPose3({0.4, 0, 0})));
  for (int i = 1; i <= 3; ++i) {
    const int64_t utime = 1'000'000 * i;
    bag.Message("/front/scan", kScanType, utime, ScanBytes(utime, "front"));
    if (i < 3) bag.Message("/back/scan", kScanType, utime, ScanBytes(utime, "back"));
    bag.Message("/tf", "tf/tfMessage", utime,
                RosTransformBytes(utime, "odom", "base_footprint", ToPose3({1.0 * i, 0, 0})));
    bag.Message("/mocap/robot", "geometry_msgs/PoseStamped", utime,
                RosPoseStampedBytes(utime, ToPose3({2.0 * i, 0, 0})));
    bag.Message("/wheels", "nav_msgs/Odometry", utime, RosOdometryBytes(utime, "base_link", ToPose3({3.0 * i, 0, 0})));
    bag.EndChunk();
  }
  return bag.Bytes();
}

TEST(ImportRosbag, FindsLidarsTruthAndOdometry) {
  const Imported log = ImportBag(TwoLidarBag());
  EXPECT_EQ(log.On("LIDAR_2D").size(), 3U);
  EXPECT_EQ(log.On("LIDAR_2D_BACK_SCAN").size(), 2U);
  EXPECT_TRUE(log.On("LIDAR_2D_BACK_SCAN_EXTRINSICS").empty()) << "tf does not say where it is";
  EXPECT_EQ(DecodeExtrinsics(log.On("LIDAR_2D_EXTRINSICS").at(0).data)->translation.x(), 0.4);
  EXPECT_EQ(PoseOn(log, "ODOMETRY").x(), 3.0);
  EXPECT_EQ(PoseOn(log, "GROUND_TRUTH").x(), 2.0);
  int64_t last = 0;
  for (const Event& event : log.events) {
    EXPECT_GE(event.utime, last);
    last = event.utime;
  }
}

TEST(ImportRosbag, OptionsOverrideWhatIsFound) {
  const std::string bag = TwoLidarBag();
  const Imported log = ImportBag(bag, {"--scan-topic", "/back/scan", "--odometry-topic", "/mocap/robot", "--base-frame",
                                       "base_footprint", "--ground-truth-topic", "/wheels"});
  EXPECT_EQ(log.On("LIDAR_2D").size(), 2U);
  EXPECT_EQ(PoseOn(log, "ODOMETRY").x(), 2.0);
  EXPECT_EQ(PoseOn(log, "GROUND_TRUTH").x(), 3.0);
  EXPECT_NEAR(DecodeExtrinsics(log.On("LIDAR_2D_FRONT_SCAN_EXTRINSICS").at(0).data)->translation.z(), 0.1, 1e-12);
  for (const char* option : {"--scan-topic", "--odometry-topic", "--ground-truth-topic", "--base-frame"})
    EXPECT_EQ(ImportBag(bag, {option, "/nothing"}).exit_code, 2) << option;
}

TEST(ImportRosbag, DamagedMessagesAndBags) {
  const std::string bag = TwoLidarBag();
  const Imported cut = ImportBag(bag.substr(0, bag.size() - 100));
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_EQ(cut.On("LIDAR_2D").size(), 2U) << "what came before is kept";
  const std::string scan = ScanBytes(1'000'000, "front");
  const Imported short_message = ImportBag(
      RosbagBuilder().Message("/scan", kScanType, 1, scan).Message("/scan", kScanType, 2, scan.substr(0, 40)).Bytes());
  EXPECT_EQ(short_message.exit_code, 3);
  EXPECT_EQ(short_message.On("LIDAR_2D").size(), 1U);
  EXPECT_EQ(ImportBag(RosbagBuilder().Bytes()).exit_code, 3) << "no scans";
}

std::string CloudAndImuBag() {
  const std::vector<RosField> fields{{"x", 0}, {"y", 4}, {"z", 8}, {"time", 12}};
  std::string points;
  for (const float time_s : {0.0F, 0.05F, 0.1F}) points += RosBytes().Put(5.0F).Put(0.0F).Put(0.0F).Put(time_s).data();
  RosbagBuilder bag;
  bag.Message("/tf", "tf2_msgs/TFMessage", 1,
              RosTransformBytes(1'000'000, "base_link", "velodyne", {{0, 0, 0.5}, Eigen::Quaterniond::Identity()}));
  for (int64_t i = 0; i < 3; ++i) {
    const int64_t utime = 1'000'000 + 100'000 * i;
    bag.Message("/points", "sensor_msgs/PointCloud2", utime, RosPointCloudBytes(utime, "velodyne", fields, 16, points));
    bag.Message("/imu", "sensor_msgs/Imu", utime, RosImuBytes(utime, "imu", {0.1, 0, 0}, {0, 0, 9.8}));
  }
  bag.Message("/map", "sensor_msgs/PointCloud2", 1, RosPointCloudBytes(1'000'000, "map", fields, 16, points));
  bag.Message("/imu", "sensor_msgs/Imu", 1, RosImuBytes(1'300'000, "imu", {NAN, 0, 0}, {0, 0, 9.8}));
  return bag.Bytes();
}

TEST(ImportRosbag, CloudsAndImu) {
  const Imported log = ImportBag(CloudAndImuBag());
  EXPECT_EQ(log.exit_code, 0);
  const std::vector<Sweep> sweeps = log.SweepsOn("LIDAR_3D");
  ASSERT_EQ(sweeps.size(), 3U);
  EXPECT_EQ(sweeps[0].utime, 1'100'000) << "the last point";
  EXPECT_EQ(sweeps[0].points.at(1).dt_us, -50'000);
  EXPECT_EQ(log.SweepsOn("LIDAR_3D_MAP").size(), 1U);
  EXPECT_EQ(DecodeExtrinsics(log.On("LIDAR_3D_EXTRINSICS").at(0).data)->translation.z(), 0.5);
  ASSERT_EQ(log.On("IMU").size(), 3U) << "and one that is not finite";
  EXPECT_EQ(DecodeImu(log.On("IMU")[1].data)->specific_force_mps2.z(), 9.8);
  EXPECT_EQ(ImportBag(CloudAndImuBag(), {"--cloud-topic", "/map"}).SweepsOn("LIDAR_3D").size(), 1U);
  EXPECT_EQ(ImportBag(CloudAndImuBag(), {"--cloud-topic", "/imu"}).exit_code, 2);
  EXPECT_EQ(ImportBag(CloudAndImuBag(), {"--imu-topic", "/other"}).exit_code, 2);
}

// An MBot log: a turn of an RPLidar, poses of both kinds, something else.
std::string MbotLog() {
  const TemporaryFile file;
  LogWriter writer(file.path());
  planar_scan_t scan{};
  scan.utime = 5'000'000;
  scan.num_ranges = 100;
  for (int i = 0; i < 100; ++i) {
    scan.ranges.push_back(1.0F);
    scan.thetas.push_back(0.06F * static_cast<float>(i));
    scan.times.push_back(scan.utime + 1000 * i);
    scan.intensities.push_back(0.0F);
  }
  writer.Write(1, "RPLIDAR_LASER", scan);
  pose_xyt_t pose{};
  pose.utime = 5'050'000;
  pose.x = 7.0F;
  for (const char* channel : {"ODOMETRY", "TRUE_POSE", "SLAM_POSE"}) writer.Write(2, channel, pose);
  writer.Write(3, "ENCODERS", Bytes(std::vector<uint8_t>(24, 1)));
  writer.Flush();
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ImportMbot, ChannelsStampsAndSense) {
  const TemporaryFile file(MbotLog());
  const Imported log("mbot", file.path());
  EXPECT_EQ(log.exit_code, 0);
  EXPECT_THAT(log.Channels(), ElementsAre("ODOMETRY", "GROUND_TRUTH", "SLAM_POSE", "LIDAR_2D"));
  EXPECT_EQ(PoseOn(log, "GROUND_TRUTH").x(), 7.0);
  EXPECT_EQ(log.On("LIDAR_2D")[0].utime, 5'099'000) << "the last beam";
  const auto angle = [&](const std::vector<std::string>& options) {
    return DecodeScan(Imported("mbot", file.path(), options).On("LIDAR_2D").at(0).data)->beams[10].angle_rad;
  };
  EXPECT_NEAR(angle({}), -0.6, 1e-6) << "an RPLidar counts clockwise";
  EXPECT_NEAR(angle({"--clockwise"}), -0.6, 1e-6);
  EXPECT_NEAR(angle({"--counter-clockwise"}), 0.6, 1e-6);
}

TEST(ImportMbot, RealLog) {
  const auto log = RealData("mbot/convex.lcm");
  if (!std::filesystem::exists(log)) GTEST_SKIP() << log << " is not there";
  const Imported imported("mbot", log);
  EXPECT_EQ(imported.exit_code, 0);
  EXPECT_EQ(imported.On("LIDAR_2D").size(), 459U);
  EXPECT_EQ(imported.On("SLAM_POSE").size(), 457U);
}

TEST(Import, BadUsageAndMissingFiles) {
  EXPECT_EQ(Bridge({"import"}), 2);
  EXPECT_EQ(Bridge({"import", "carmen"}), 2);
  EXPECT_EQ(Bridge({"import", "tarot", "x"}), 2);
  for (const char* format : {"carmen", "rosbag", "mbot", "velodyne"}) {
    const TemporaryFile out;
    EXPECT_EQ(Bridge({"import", format, "/no/such/file", "--log-out", out.path()}), 3);
    const TemporaryFile rubbish(std::string(1000, '\xd1'));
    EXPECT_EQ(Bridge({"import", format, rubbish.path(), "--log-out", out.path(), "--quiet"}), 3);
    EXPECT_EQ(Bridge({"import", format, rubbish.path(), "--log-out", rubbish.path()}), 2) << "in place";
    EXPECT_EQ(Bridge({"import", format, rubbish.path(), "--speed", "-1"}), 2);
    EXPECT_EQ(Bridge({"import", format, rubbish.path(), "--lcm-url", "nonsense://"}), 2);
  }
  const TemporaryFile log(kFlaser);
  EXPECT_EQ(Bridge({"import", "carmen", log.path(), "--log-out", "/no/such/folder/a.lcm"}), 1);
  EXPECT_EQ(Bridge({"import", "carmen", log.path(), "--max-range", "-3"}), 2);
}

TEST(Import, LiveAsFastAsItGoes) {
  const TemporaryFile log(kFlaser);
  EXPECT_EQ(Bridge({"import", "carmen", log.path(), "--lcm-url", "memq://", "--speed", "0", "--quiet"}), 0);
}

}  // namespace
}  // namespace lcmslam
