// The bags of ../shared/data against their text forms, which were made by other means.

#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/trajectory.h"
#include "sensors/frame_tree.h"
#include "sensors/input_file.h"
#include "sensors/ros_messages.h"
#include "sensors/rosbag_reader.h"
#include "support/real_data.h"

namespace lcmslam {
namespace {

// Calls `handle(topic, type, data)` for every message.
template <class Handler>
void ForEachMessage(const std::filesystem::path& bag, const Handler& handle) {
  for (RosbagReader reader(bag); const auto message = reader.Next();)
    handle(message->connection->topic, message->connection->type, message->data);
}

std::vector<std::vector<double>> ReadRows(const std::filesystem::path& path) {
  std::vector<std::vector<double>> rows;
  const auto file = OpenInput(path);
  for (std::string line; std::getline(*file, line);) {
    std::istringstream values(line);
    rows.emplace_back(std::istream_iterator<double>(values), std::istream_iterator<double>());
  }
  return rows;
}

int64_t ToUtime(double seconds) { return std::llround(seconds * 1e6); }

// Rows of `t x y theta`, in the text's six decimals.
void ExpectPose(const std::vector<double>& row, const Pose2& pose, double tolerance) {
  EXPECT_NEAR(pose.x(), row[1], tolerance);
  EXPECT_NEAR(pose.y(), row[2], tolerance);
  EXPECT_NEAR(WrapAngle(pose.yaw() - row[3]), 0.0, tolerance);
}

struct ScanCase {
  const char* bag;
  const char* topic;
  const char* text;
  size_t num_scans;
};

class RealScans : public testing::TestWithParam<ScanCase> {};

TEST_P(RealScans, EqualTheirTextForm) {
  const ScanCase& c = GetParam();
  if (!std::filesystem::exists(RealData(c.bag))) GTEST_SKIP() << RealData(c.bag) << " is not there";
  const auto rows = ReadRows(RealData(c.text));
  size_t i = 0;
  ForEachMessage(RealData(c.bag), [&](const std::string& topic, const std::string& type, auto data) {
    if (topic != c.topic) return;
    ASSERT_EQ(type, "sensor_msgs/LaserScan");
    const RosLaserScan message = DecodeRosLaserScan(data);
    const PlanarScan scan = ToPlanarScan(message, false);
    ASSERT_LT(i, rows.size());
    const std::vector<double>& row = rows[i++];      // t angle_min angle_inc n r0 ...
    EXPECT_NEAR(message.utime, ToUtime(row[0]), 1);  // the text went through double seconds
    ASSERT_EQ(scan.beams.size(), static_cast<size_t>(row[3]));
    ASSERT_EQ(row.size(), scan.beams.size() + 4);
    for (size_t k = 0; k < scan.beams.size(); ++k) {
      ASSERT_NEAR(scan.beams[k].angle_rad, row[1] + row[2] * static_cast<double>(k), 1e-5);
      ASSERT_NEAR(scan.beams[k].range_m, row[4 + k], 1e-3) << "scan " << i << " beam " << k;
    }
    EXPECT_EQ(scan.beams.back().dt_us, 0);
    EXPECT_EQ(scan.utime + scan.beams.front().dt_us, message.utime);
  });
  EXPECT_EQ(i, c.num_scans);
  EXPECT_EQ(rows.size(), c.num_scans);
}

INSTANTIATE_TEST_SUITE_P(
    Bags, RealScans,
    testing::Values(ScanCase{"jarvis/jarvis_circular_path_fast.bag", "/driver_laser_security/laser_scan",
                             "jarvis/jarvis_circular_s3000.scan.gz", 213},
                    ScanCase{"guardian/guardian_3.bag", "/scan", "guardian/guardian3_front.scan.gz", 1036},
                    ScanCase{"guardian/guardian_3.bag", "/hokuyo_back_scan", "guardian/guardian3_back.scan.gz", 1038}),
    [](const auto& param_info) { return "case" + std::to_string(param_info.index); });

TEST(RealBags, JarvisGroundTruth) {
  const auto bag = RealData("jarvis/jarvis_circular_path_fast.bag");
  if (!std::filesystem::exists(bag)) GTEST_SKIP() << bag << " is not there";
  const auto rows = ReadRows(RealData("jarvis/jarvis_circular_s3000.gt"));
  size_t i = 0;
  ForEachMessage(bag, [&](const std::string& topic, const std::string& type, auto data) {
    if (topic != "/pose_ground_truth") return;
    const RosPose pose = DecodeRosPose(type, data);
    ASSERT_LT(i, rows.size());
    EXPECT_NEAR(pose.utime, ToUtime(rows[i][0]), 1);  // the text went through double seconds
    ExpectPose(rows[i++], ToPose2(pose.T_frame_child), 2e-6);
  });
  EXPECT_EQ(i, rows.size());
}

// Both robots say on tf where they are in `odom` and where their lidars are.
struct Transforms {
  FrameTree tree;
  Trajectory odometry;

  explicit Transforms(const std::filesystem::path& bag) {
    ForEachMessage(bag, [&](const std::string&, const std::string& type, auto data) {
      if (!IsRosTransformsType(type)) return;
      for (const RosPose& pose : DecodeRosTransforms(data)) {
        tree.Add(pose.frame, pose.child_frame, pose.T_frame_child);
        if (pose.frame == "odom" && pose.child_frame == "base_footprint")
          odometry.push_back({pose.utime, pose.T_frame_child});
      }
    });
  }
  Pose2 Mounting(const std::string& frame) const { return ToPose2(tree.Find("base_footprint", frame)->T_base_frame); }
  // The text form has odometry interpolated at the scans.
  void ExpectOdometry(const std::string& text) const {
    size_t inside = 0;
    for (const std::vector<double>& row : ReadRows(RealData(text))) {
      const auto pose = InterpolateAt(odometry, ToUtime(row[0]));
      if (!pose) continue;  // before the first or after the last odometry
      ExpectPose(row, ToPose2(*pose), 1e-4);
      ++inside;
    }
    EXPECT_GT(inside, 200U);
  }
};

TEST(RealBags, JarvisOdometryAndMountings) {
  const auto bag = RealData("jarvis/jarvis_circular_path_fast.bag");
  if (!std::filesystem::exists(bag)) GTEST_SKIP() << bag << " is not there";
  const Transforms transforms(bag);
  EXPECT_NEAR(transforms.Mounting("base_laser_security_link").x(), 0.895, 1e-9);
  EXPECT_NEAR(transforms.Mounting("base_laser_navigation_link").x(), 0.194, 1e-9);
  transforms.ExpectOdometry("jarvis/jarvis_circular_s3000.odom");
}

TEST(RealBags, GuardianOdometryAndMountings) {
  const auto bag = RealData("guardian/guardian_3.bag");
  if (!std::filesystem::exists(bag)) GTEST_SKIP() << bag << " is not there";
  const Transforms transforms(bag);
  const Pose2 front = transforms.Mounting("hokuyo_frontal_laser_link");
  const Pose2 back = transforms.Mounting("hokuyo_back_laser_link");
  EXPECT_NEAR(front.x(), 0.486, 5e-4);
  EXPECT_NEAR(front.yaw(), 0.0, 1e-3);
  EXPECT_NEAR(back.x(), -0.4317, 5e-4);
  EXPECT_NEAR(std::abs(back.yaw()), std::numbers::pi, 1e-9);
  transforms.ExpectOdometry("guardian/guardian3_front.odom");

  // Its odometry messages say the same, at a lower rate.
  size_t messages = 0;
  ForEachMessage(bag, [&](const std::string&, const std::string& type, auto data) {
    if (type != "nav_msgs/Odometry") return;
    const RosPose pose = DecodeRosPose(type, data);
    EXPECT_EQ(pose.child_frame, "base_footprint");
    const auto by_tf = InterpolateAt(transforms.odometry, pose.utime);
    if (!by_tf) return;
    EXPECT_LT((by_tf->translation - pose.T_frame_child.translation).norm(), 0.02);
    ++messages;
  });
  EXPECT_GT(messages, 2000U);
}

}  // namespace
}  // namespace lcmslam
