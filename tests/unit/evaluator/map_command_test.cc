#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "evaluator/evaluation.pb.h"
#include "evaluator/files.h"
#include "evaluator/result.h"
#include "lidar/occupancy_grid.h"
#include "support/temporary_file.h"
#include "unit/evaluator/run_evaluator.h"

namespace lcmslam {
namespace {

using ::testing::HasSubstr;

constexpr double kHalf_m = 2.2;  // of a square room around the origin

double RangeInRoom(const Pose2& T_world_body, double angle_rad) {
  const double direction = T_world_body.yaw() + angle_rad;
  const auto to_wall = [](double p, double d) { return d > 0 ? (kHalf_m - p) / d : (-kHalf_m - p) / d; };
  return std::min(to_wall(T_world_body.x(), std::cos(direction)), to_wall(T_world_body.y(), std::sin(direction)));
}

// Scans and true poses of a slow way through the room; SDF2D_POSE sways by `sway_m` in x.
void WriteRoomLog(const std::filesystem::path& path, double sway_m = 0.0) {
  LogWriter writer(path);
  for (int k = 0; k < 100; ++k) {
    const int64_t utime = 1'000'000 + 100'000 * k;
    const Pose2 truth(0.01 * k - 0.5, 0.3 * std::sin(0.05 * k), 0.02 * k);
    const Pose2 estimate(truth.x() + sway_m * std::sin(2.1 * k), truth.y(), truth.yaw());
    PlanarScan scan{utime, {}};
    for (int i = 0; i < 720; ++i) {
      const double angle_rad = i * M_PI / 360.0 - M_PI;
      scan.beams.push_back({static_cast<float>(RangeInRoom(truth, angle_rad)), static_cast<float>(angle_rad), 0});
    }
    writer.Write(utime, "GROUND_TRUTH", ToMessage(StampedPose{utime, ToPose3(truth)}));
    writer.Write(utime, "SDF2D_POSE", ToMessage(StampedPose{utime, ToPose3(estimate)}));
    writer.Write(utime, "LIDAR_2D", ToMessage(scan));
  }
  writer.Flush();
}

// The room's walls `offset_m` too far to the right, without its left one.
std::string WriteMapOfRoom(const std::filesystem::path& folder, double offset_m) {
  OccupancyGrid grid{{-3.0 + offset_m, -3.0}, 0.02, 300, 300, std::vector<int8_t>(300 * 300, -100)};
  for (int i = 41; i < 259; ++i) {
    for (const auto& [column, row] : {std::pair{259, i}, {i, 40}, {i, 259}}) grid.cells[row * 300 + column] = 100;
  }
  const std::string stem = folder / "room";
  EXPECT_EQ(WriteMapFiles(grid, stem), "");
  return stem + ".yaml";
}

testing::Outcome Map(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "map");
  return testing::RunEvaluator(arguments);
}

TEST(MapCommand, DistanceAndCompleteness) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "truth.lcm", json = folder.path() / "quality.json";
  WriteRoomLog(log);
  const std::string map = WriteMapOfRoom(folder.path(), 0.0);
  const testing::Outcome run = Map({"--map", map, "--truth", log, "--json", json, "--quiet"});
  ASSERT_EQ(run.code, 0) << run.error;
  result::MapQuality quality;
  ReadJson(json, quality);
  EXPECT_NEAR(quality.surface_error_m().mean(), 0.01, 0.002) << "walls lie on the edges of cells";
  ASSERT_EQ(quality.completeness_size(), 3);
  EXPECT_NEAR(quality.completeness(0).share(), 0.75, 0.02) << "one of four walls is missing";
  EXPECT_THAT(run.out, HasSubstr("true surface mapped within 10 cm: 7"));
}

TEST(MapCommand, TheMapMovesWithItsTrajectory) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "truth.lcm", metrics = folder.path() / "metrics.json";
  const std::string json = folder.path() / "quality.json";
  WriteRoomLog(log);
  const std::string map = WriteMapOfRoom(folder.path(), 0.3);
  result::Evaluation evaluation;
  evaluation.mutable_alignment()->mutable_t_world_map()->set_x_m(-0.3);
  evaluation.mutable_alignment()->mutable_t_world_map()->set_qw(1.0);
  WriteFile(metrics, ToJson(evaluation));
  ASSERT_EQ(Map({"--map", map, "--truth", log, "--metrics", metrics, "--json", json, "--quiet"}).code, 0);
  result::MapQuality quality;
  ReadJson(json, quality);
  EXPECT_NEAR(quality.surface_error_m().mean(), 0.01, 0.002);
}

TEST(MapCommand, WallsAreAsThickAsTheEstimateSways) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "run.lcm", json = folder.path() / "quality.json";
  WriteRoomLog(log, 0.04);
  ASSERT_EQ(Map({"--log-in", log, "--json", json, "--quiet"}).code, 0);
  result::MapQuality quality;
  ReadJson(json, quality);
  EXPECT_NEAR(quality.wall_thickness_m().max(), 0.04 / std::sqrt(2.0), 0.005) << "across the sway";
  EXPECT_LT(quality.wall_thickness_m().min(), 0.001) << "along it";
  ASSERT_EQ(Map({"--log-in", log, "--estimate", "GROUND_TRUTH", "--json", json, "--quiet"}).code, 0);
  ReadJson(json, quality);
  EXPECT_LT(quality.wall_thickness_m().max(), 0.001);
}

TEST(MapCommand, SaysInOneLineWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "truth.lcm";
  WriteRoomLog(log);
  const std::string map = WriteMapOfRoom(folder.path(), 0.0);
  const TemporaryFile rubbish("rubbish", ".sdf"), json("{}", ".json"), ply("ply\nrubbish\n", ".ply");
  const auto expect = [](std::vector<std::string> arguments, int code, const std::string& error) {
    arguments.insert(arguments.begin(), {"map", "--quiet"});
    testing::ExpectRefused(arguments, code, error);
  };
  expect({}, 2, "either --map FILE with --truth LOG, or --log-in LOG");
  expect({"--map", map}, 2, "--truth LOG: required");
  expect({"--map", rubbish.path(), "--truth", log}, 3, rubbish.path().string());
  expect({"--map", ply.path(), "--truth", log}, 3, ply.path().string());
  expect({"--map", "map.txt", "--truth", log}, 3, "map.txt: not a .sdf, .yaml or .ply map");
  expect({"--map", map, "--truth", "none.lcm"}, 3, "none.lcm");
  expect({"--map", map, "--truth", log, "--metrics", json.path()}, 3, "no alignment in it");
  expect({"--log-in", log, "--estimate", "NONE"}, 4, "no poses on NONE");
}

}  // namespace
}  // namespace lcmslam
