#include "common/planar_slam_service.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"
#include "unit/common/slam_service_run.h"

namespace lcmslam {
namespace {

// Walks one metre along x with every scan; writes down what it is told.
class FakeSlam : public PlanarSlam {
 public:
  explicit FakeSlam(std::vector<std::string>& calls) : calls_(calls) {}
  PlanarUpdate Process(const PlanarScan& scan, slam_diagnostics_t& diagnostics) override {
    diagnostics.num_stages = 1;
    diagnostics.stage_ms = {42.0F};
    diagnostics.stage_name = {"walk"};
    x_m_ += 1.0;
    return {!scan.beams.empty(), scan.utime, Pose2(x_m_, 0.0, 0.5), {1.0, 0.0, 0.25}};
  }
  void AddOdometry(int64_t utime, const Pose2&) override { calls_.push_back("odometry " + std::to_string(utime)); }
  void SetMounting(const Pose2&) override { calls_.push_back("mounting"); }
  void Reset() override { calls_.push_back("reset"); }
  void SetPose(const Pose2& T) override { x_m_ = T.x(); }
  void SetLocalizeOnly(bool only) override { calls_.push_back(only ? "localize" : "map"); }
  OccupancyGrid Grid() const override { return {{0, 0}, 0.05, 2, 1, {-1, 1}}; }
  std::string SaveMap(const std::string& stem) const override {
    calls_.push_back("save " + std::filesystem::path(stem).filename().string());
    return "";
  }
  std::string LoadMap(const std::string& path) override { return path + ": no such map"; }
  void PublishMap(ServiceContext&, int64_t) override { calls_.push_back("tiles"); }

 private:
  std::vector<std::string>& calls_;
  double x_m_ = 0.0;
};

class PlanarSlamServiceTest : public SlamServiceRun {
 protected:
  std::unique_ptr<Service> MakeService(ServiceContext& context) override {
    PlanarSlamOptions options;
    options.odometry_channel = "ODOMETRY";
    options.pose_channel = "FAKE_POSE";
    options.diagnostics_channel = "FAKE_DIAGNOSTICS";
    options.mounting_configured = true;
    return std::make_unique<PlanarSlamService>(options, 77, std::make_unique<FakeSlam>(calls_), "fake-slam", context);
  }
  void WriteScan(int64_t utime, size_t beams = 3) {
    Write(utime, "LIDAR_2D", ToMessage(PlanarScan{utime, std::vector<Beam>(beams, {1.0F, 0.0F, 0})}));
  }
};

TEST_F(PlanarSlamServiceTest, PublishesPoseAtTheScan) {
  WriteScan(1000);
  WriteScan(2000, 0);  // no beams: skipped
  WriteScan(3000);
  const auto events = RunAndRead("FAKE_POSE");
  ASSERT_EQ(events.size(), 2U);
  const auto pose = Decode<pose_t>(events[1].data);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->utime, 3000);
  EXPECT_EQ(pose->pos[0], 3.0);
  EXPECT_NEAR(pose->vel[0], std::cos(0.5), 1e-12) << "map frame";
  EXPECT_EQ(pose->rotation_rate[2], 0.25);

  std::ifstream tum(folder_ / "fake-slam_tum.txt");
  std::string first;
  std::getline(tum, first);
  EXPECT_THAT(first, testing::StartsWith("0.001000000 1.000000000 0.000000000"));
}

TEST_F(PlanarSlamServiceTest, DiagnosticsForEveryScanWithoutWallClock) {
  WriteScan(1000);
  WriteScan(2000, 0);
  const auto events = RunAndRead("FAKE_DIAGNOSTICS");
  ASSERT_EQ(events.size(), 2U);
  const auto diagnostics = Decode<slam_diagnostics_t>(events[1].data);
  ASSERT_TRUE(diagnostics);
  EXPECT_EQ(diagnostics->sequence, 1);
  EXPECT_EQ(diagnostics->config_hash, 77);
  EXPECT_EQ(diagnostics->stage_ms, std::vector<float>{0.0F});
}

TEST_F(PlanarSlamServiceTest, GridIsMBots) {
  WriteScan(1000);
  const auto events = RunAndRead("SLAM_MAP");
  ASSERT_EQ(events.size(), 1U);
  const auto grid = Decode<occupancy_grid_t>(events[0].data);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->width, 2);
  EXPECT_EQ(grid->num_cells, 2);
  EXPECT_EQ(grid->cells, (std::vector<int8_t>{-1, 1}));
}

TEST_F(PlanarSlamServiceTest, ObeysCommands) {
  WriteCommand(1, slam_command_t::SET_POSE, 10.0);
  WriteScan(1000);
  WriteCommand(1001, slam_command_t::SET_POSE, 50.0, "another-slam");
  WriteCommand(1002, slam_command_t::RESET);
  WriteCommand(1003, slam_command_t::LOCALIZE_ONLY);
  WriteCommand(1004, slam_command_t::SAVE);
  Write(1005, "SLAM_COMMAND", Bytes());
  WriteScan(2000);
  const auto poses = RunAndRead("FAKE_POSE");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(Decode<pose_t>(poses[0].data)->pos[0], 11.0);
  EXPECT_EQ(Decode<pose_t>(poses[1].data)->pos[0], 12.0);
  EXPECT_EQ(refused_, 1);
  EXPECT_THAT(calls_, testing::IsSupersetOf({"reset", "localize", "save fake-slam_map"}));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fake-slam_map.pgm"));
}

TEST_F(PlanarSlamServiceTest, OdometryReachesTheAlgorithm) {
  Write(5, "ODOMETRY", ToMessage(StampedPose{5, {}}));
  Write(6, "ODOMETRY", Bytes());
  WriteScan(1000);
  RunAndRead("");
  EXPECT_THAT(calls_, testing::Contains("odometry 5"));
  EXPECT_EQ(refused_, 1);
}

}  // namespace
}  // namespace lcmslam
