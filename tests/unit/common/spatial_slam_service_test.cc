#include "common/spatial_slam_service.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"
#include "bus/sweep_chunks.h"
#include "unit/common/slam_service_run.h"

namespace lcmslam {
namespace {

// Where the lidar is when the body is at the origin: half a metre ahead, looking left.
const Pose3 kMounting{{0.5, 0.0, 0.0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()))};

// Stays where it was put, turning at 2 rad/s; writes down what it is told.
class FakeSlam : public SpatialSlam {
 public:
  explicit FakeSlam(std::vector<std::string>& calls) : calls_(calls) {}
  SpatialUpdate Process(const Sweep& sweep, const LidarMotion& motion, slam_diagnostics_t& diagnostics) override {
    diagnostics.status = slam_diagnostics_t::TRACKING;
    calls_.push_back("sweep of " + std::to_string(sweep.points.size()));
    if (motion.rotation) calls_.push_back("imu");
    if (motion.odometry) calls_.push_back("odometry");
    SpatialUpdate update{.has_pose = !sweep.points.empty(), .utime = sweep.utime, .T_map_lidar = T_map_lidar_};
    update.angular_velocity = {0.0, 0.0, 2.0};
    update.covariance.diagonal() << 0.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    return update;
  }
  void SetPose(const Pose3& T_map_lidar) override { T_map_lidar_ = T_map_lidar; }
  void Reset() override { calls_.push_back("reset"); }
  void SetLocalizeOnly(bool only) override { calls_.push_back(only ? "localize" : "map"); }
  std::string SaveMap(const std::string& stem) const override {
    calls_.push_back("save " + std::filesystem::path(stem).filename().string());
    return "";
  }
  std::string LoadMap(const std::string& path) override { return path + ": no such map"; }
  void PublishMap(ServiceContext&, int64_t) override { calls_.push_back("surfels"); }

 private:
  std::vector<std::string>& calls_;
  Pose3 T_map_lidar_;
};

class SpatialSlamServiceTest : public SlamServiceRun {
 protected:
  void SetUp() override {
    options_.pose_channel = "FAKE_POSE";
    options_.diagnostics_channel = "FAKE_DIAGNOSTICS";
    options_.odometry_channel = "ODOMETRY";
    options_.imu_channel = "IMU";
  }
  std::unique_ptr<Service> MakeService(ServiceContext& context) override {
    return std::make_unique<SpatialSlamService>(options_, 77, std::make_unique<FakeSlam>(calls_), "fake-slam", context);
  }

  // `lost`: chunks at the end that do not come.
  void WriteSweep(int64_t utime, size_t points = 5000, size_t lost = 0) {
    const Sweep sweep{utime, std::vector<SweepPoint>(points)};
    auto chunks = ToChunks(sweep, sweep_number_++);
    chunks.resize(chunks.size() - lost);
    for (const auto& chunk : chunks) Write(utime, "LIDAR_3D", chunk);
  }
  void WriteMounting() { Write(0, "LIDAR_3D_EXTRINSICS", ExtrinsicsMessage(0, kMounting)); }

  SpatialSlamOptions options_;
  int32_t sweep_number_ = 0;
};

TEST_F(SpatialSlamServiceTest, PublishesTheBody) {
  options_.T_map_body_initial.translation = {1.0, 2.0, 3.0};
  WriteMounting();
  WriteSweep(1000);
  const auto events = RunAndRead("FAKE_POSE");
  ASSERT_EQ(events.size(), 1U);
  const auto pose = Decode<pose_t>(events[0].data);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->utime, 1000);
  EXPECT_THAT(pose->pos, testing::Pointwise(testing::DoubleNear(1e-12), {1.0, 2.0, 3.0}));
  EXPECT_THAT(pose->orientation, testing::Pointwise(testing::DoubleNear(1e-12), {1.0, 0.0, 0.0, 0.0}));
  // The lidar rests 0.5 m ahead of the body and turns: the body swings about it.
  EXPECT_THAT(pose->vel, testing::Pointwise(testing::DoubleNear(1e-12), {0.0, -1.0, 0.0}));
  EXPECT_NEAR(pose->rotation_rate[2], 2.0, 1e-12);
  std::ifstream tum(folder_ / "fake-slam_tum.txt");
  std::string first;
  std::getline(tum, first);
  EXPECT_THAT(first, testing::StartsWith("0.001000000 1.000000000 2.000000000 3.000000000"));
}

// The lidar's yaw of 1 rad^2 moves the body, half a metre behind, sideways.
TEST_F(SpatialSlamServiceTest, CovarianceIsTheBodys) {
  WriteMounting();
  WriteSweep(1000);
  const auto events = RunAndRead("FAKE_DIAGNOSTICS");
  ASSERT_EQ(events.size(), 1U);
  const auto diagnostics = Decode<slam_diagnostics_t>(events[0].data);
  ASSERT_TRUE(diagnostics);
  ASSERT_EQ(diagnostics->dof, 6);
  ASSERT_EQ(diagnostics->covariance.size(), 36U);
  EXPECT_NEAR(diagnostics->covariance[7], 0.25, 1e-12) << "y y";
  EXPECT_NEAR(diagnostics->covariance[11], -0.5, 1e-12) << "y yaw";
  EXPECT_NEAR(diagnostics->covariance[35], 1.0, 1e-12) << "yaw yaw";
  EXPECT_EQ(diagnostics->config_hash, 77);
}

TEST_F(SpatialSlamServiceTest, ConfiguredMountingNeedsNoMessage) {
  options_.mounting_configured = true;
  options_.T_body_lidar = kMounting;
  WriteSweep(1000);
  const auto events = RunAndRead("FAKE_POSE");
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(Decode<pose_t>(events[0].data)->pos[0], 0.0, 1e-12);
}

TEST_F(SpatialSlamServiceTest, LostChunksAreCountedAndTheRestIsUsed) {
  WriteSweep(1000, 2400);
  WriteSweep(101000, 2400, 1);
  WriteSweep(201000, 2400);
  EXPECT_EQ(RunAndRead("FAKE_POSE").size(), 3U);
  EXPECT_EQ(missing_, 1);
  EXPECT_THAT(calls_, testing::IsSupersetOf({"sweep of 2400", "sweep of 1600"}));
}

TEST_F(SpatialSlamServiceTest, SweepsThatTheLidarSkippedAreCounted) {
  for (const int64_t period : {0, 1, 2, 3, 4, 5, 6, 10, 11}) WriteSweep(1000 + 100'000 * period);
  EXPECT_EQ(RunAndRead("FAKE_POSE").size(), 9U);
  EXPECT_EQ(missing_, 3);
}

// A sender that starts anew numbers its sweeps anew: only the stamps tell what was lost in between.
TEST_F(SpatialSlamServiceTest, SweepsLostBeforeTheSenderBeganAnewAreCounted) {
  for (const int64_t period : {0, 1, 2, 3, 4, 5, 6}) WriteSweep(1000 + 100'000 * period, 2400);
  sweep_number_ = 0;
  WriteSweep(2'601'000, 2400, 1);
  WriteSweep(2'701'000, 2400);
  EXPECT_EQ(RunAndRead("FAKE_POSE").size(), 9U);
  EXPECT_EQ(missing_, 19);
}

TEST_F(SpatialSlamServiceTest, TheLastSweepNeedNotBeWhole) {
  WriteSweep(1000, 6000, 1);
  EXPECT_EQ(RunAndRead("FAKE_POSE").size(), 1U);
}

TEST_F(SpatialSlamServiceTest, SkippedSweepsHaveDiagnosticsOnly) {
  WriteSweep(1000, 0);
  EXPECT_EQ(RunAndRead("FAKE_DIAGNOSTICS").size(), 1U);
  EXPECT_TRUE(RunAndRead("FAKE_POSE").empty());
}

TEST_F(SpatialSlamServiceTest, OtherSensorsReachTheAlgorithm) {
  options_.mounting_configured = true;
  for (int64_t t = 0; t <= 300'000; t += 10'000) {
    Write(t, "IMU", ToMessage(ImuSample{t, Eigen::Vector3d::UnitX(), {}}));
    Write(t, "ODOMETRY", ToMessage(StampedPose{t, {}}));
    if (t == 100'000 || t == 200'000) WriteSweep(t);
  }
  Write(300'001, "IMU", std::vector<uint8_t>(10));
  Write(300'002, "ODOMETRY", std::vector<uint8_t>(10));
  RunAndRead("");
  EXPECT_THAT(calls_, testing::IsSupersetOf({"imu", "odometry"}));
  EXPECT_EQ(refused_, 2);
}

TEST_F(SpatialSlamServiceTest, ObeysCommands) {
  WriteMounting();
  WriteCommand(1, slam_command_t::SET_POSE, 10.0);
  WriteSweep(1000);
  WriteCommand(1001, slam_command_t::RESET);
  WriteCommand(1002, slam_command_t::LOCALIZE_ONLY);
  WriteCommand(1003, slam_command_t::SAVE);
  WriteSweep(2000);
  const auto poses = RunAndRead("FAKE_POSE");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_NEAR(Decode<pose_t>(poses[0].data)->pos[0], 10.0, 1e-12);
  EXPECT_NEAR(Decode<pose_t>(poses[1].data)->pos[0], 0.0, 1e-12) << "the initial pose";
  EXPECT_THAT(calls_, testing::IsSupersetOf({"reset", "localize", "save fake-slam_map", "surfels"}));
}

TEST_F(SpatialSlamServiceTest, AMapThatCannotBeReadEndsTheRun) {
  options_.load_map = "nothing.surfels";
  EXPECT_THROW(RunAndRead(""), CommandError);
}

}  // namespace
}  // namespace lcmslam
