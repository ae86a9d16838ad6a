// `sensor-bridge import kitti|pcd|ply` from a folder to the log it writes.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bus/messages.h"
#include "support/real_data.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

namespace fs = std::filesystem;

void Write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

// x, y, z and a reflectance for each point.
std::string KittiBytes(const std::vector<std::array<float, 4>>& points) {
  return {reinterpret_cast<const char*>(points.data()), points.size() * sizeof points[0]};
}
const std::string kScan = KittiBytes({{-3, -0.01F, 0, 0.5F}, {4, 0, 0, 0.25F}, {0, 0, 0, 0}, {NAN, 1, 1, 0}});

std::string PcdText(float x) {
  return fmt::format(
      "VERSION .7\nFIELDS x y z ring time\nSIZE 4 4 4 2 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\n"
      "POINTS 2\nDATA ascii\n{0} 1 2 3 0\n{0} 1 2 4 -0.05\n",
      x);
}
std::string PlyText(float x) {
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n{} 1 2\n",
      x);
}

TEST(ImportKitti, BenchmarkSequence) {
  const TemporaryFolder folder;
  for (const char* name : {"000000.bin", "000001.bin"}) Write(folder.path() / "velodyne" / name, kScan);
  Write(folder.path() / "times.txt", "0.0\n1.037e-01\n");
  // The camera looks along the lidar's x, 0.3 m behind it, and moves 1 m along its own z.
  Write(folder.path() / "calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0.3\n");
  Write(folder.path() / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  const Imported log("kitti", folder.path());
  EXPECT_EQ(log.exit_code, 0);
  const std::vector<Sweep> sweeps = log.SweepsOn("LIDAR_3D");
  ASSERT_EQ(sweeps.size(), 2U);
  EXPECT_EQ(sweeps[1].utime, 103'700);
  ASSERT_EQ(sweeps[1].points.size(), 2U) << "without what is no return";
  EXPECT_EQ(sweeps[1].points[1].intensity, 0.25F);
  EXPECT_EQ(sweeps[1].points[0].dt_us, 0) << "compensated for motion";
  ASSERT_EQ(log.On("GROUND_TRUTH").size(), 2U);
  const StampedPose truth = *DecodePose(log.On("GROUND_TRUTH")[1].data);
  EXPECT_EQ(truth.utime, 103'700);
  EXPECT_TRUE(truth.pose.translation.isApprox(Eigen::Vector3d(1, 0, 0), 1e-9)) << "the lidar moves along its x";
}

TEST(ImportKitti, RawDrive) {
  const TemporaryFolder folder;
  Write(folder.path() / "velodyne_points/data/0000000000.bin", kScan);
  Write(folder.path() / "velodyne_points/timestamps.txt", "1970-01-01 00:00:10.5\n");
  const std::vector<Sweep> ahead = Imported("kitti", folder.path()).SweepsOn("LIDAR_3D");
  ASSERT_EQ(ahead.size(), 1U);
  EXPECT_EQ(ahead[0].utime, 10'550'000) << "stamped while it looks ahead";
  EXPECT_EQ(ahead[0].points[0].x, 4.0F) << "in the order of time";
  EXPECT_EQ(ahead[0].points[0].dt_us, -50'000);
  EXPECT_NEAR(ahead[0].points[1].dt_us, 0, 100);
  Write(folder.path() / "velodyne_points/timestamps_end.txt", "1970-01-01 00:00:10.56\n");
  EXPECT_EQ(Imported("kitti", folder.path()).SweepsOn("LIDAR_3D").at(0).utime, 10'560'000);
}

TEST(ImportKitti, ScansSideBySide) {
  const TemporaryFolder folder;
  for (const char* name : {"2.bin", "0.bin", "1.bin"}) Write(folder.path() / name, kScan);
  const Imported log("kitti", folder.path(), {"--rate", "2", "--lidar", "vlp16", "--turn", "0.2"});
  const std::vector<Sweep> sweeps = log.SweepsOn("LIDAR_3D");
  ASSERT_EQ(sweeps.size(), 3U);
  EXPECT_EQ(sweeps[2].utime, 1'100'000);
  EXPECT_EQ(sweeps[2].points[0].dt_us, -100'000);
  EXPECT_GE(sweeps[2].points[0].ring, 7) << "level";
  EXPECT_TRUE(log.On("GROUND_TRUTH").empty());
}

TEST(ImportClouds, NumbersInNamesCount) {
  const TemporaryFolder folder;
  for (const int scan : {0, 2, 10, 100}) Write(folder.path() / fmt::format("scan{}.ply", scan), PlyText(1.0F + scan));
  const std::vector<Sweep> sweeps = Imported("ply", folder.path()).SweepsOn("LIDAR_3D");
  ASSERT_EQ(sweeps.size(), 4U);
  for (const size_t i : {1U, 2U, 3U}) EXPECT_GT(sweeps[i].points[0].x, sweeps[i - 1].points[0].x) << i;
}

TEST(ImportClouds, PcdAndPly) {
  const TemporaryFolder folder;
  for (const int i : {1, 2}) {
    Write(folder.path() / fmt::format("{}.pcd", i), PcdText(static_cast<float>(i)));
    Write(folder.path() / fmt::format("{}.ply", i), PlyText(static_cast<float>(i)));
  }
  Write(folder.path() / "times.txt", "5\n6\n");
  const std::vector<Sweep> pcd = Imported("pcd", folder.path()).SweepsOn("LIDAR_3D");
  ASSERT_EQ(pcd.size(), 2U);
  EXPECT_EQ(pcd[1].utime, 6'000'000);
  EXPECT_EQ(pcd[1].points[0].x, 2.0F);
  EXPECT_EQ(pcd[1].points[0].ring, 4) << "in the order of time";
  EXPECT_EQ(pcd[1].points[0].dt_us, -50'000);
  const std::vector<Sweep> ply = Imported("ply", folder.path()).SweepsOn("LIDAR_3D");
  ASSERT_EQ(ply.size(), 2U);
  EXPECT_EQ(ply[0].points.at(0).x, 1.0F);
}

TEST(ImportClouds, BadFoldersAndFiles) {
  const TemporaryFolder folder;
  const fs::path& path = folder.path();
  for (const char* format : {"kitti", "pcd", "ply"}) {
    EXPECT_EQ(Imported(format, path).exit_code, 3) << "nothing in it";
    EXPECT_EQ(Imported(format, path / "none").exit_code, 3);
  }
  Write(path / "0.bin", kScan);
  Write(path / "1.bin", kScan.substr(1));
  const Imported damaged("kitti", path);
  EXPECT_EQ(damaged.exit_code, 3);
  EXPECT_EQ(damaged.SweepsOn("LIDAR_3D").size(), 1U) << "what came before is kept";
  Write(path / "times.txt", "1\n");
  EXPECT_EQ(Imported("kitti", path).exit_code, 3) << "one time, two scans";
  EXPECT_EQ(Imported("kitti", path / "0.bin").exit_code, 3) << "no folder";
  EXPECT_EQ(Imported("kitti", path, {"--poses", path / "none.txt"}).exit_code, 2);
  EXPECT_EQ(Imported("kitti", path, {"--rate", "0"}).exit_code, 2);
  EXPECT_EQ(Imported("kitti", path, {"--turn", "nan"}).exit_code, 2);
  EXPECT_EQ(Imported("kitti", path, {"--lidar", "sick"}).exit_code, 2);
}

TEST(ImportKitti, RealFolders) {
  const auto hilti = RealData("hilti2021_uzh_run2");
  if (!fs::exists(hilti)) GTEST_SKIP() << hilti << " is not there";
  const Imported log("kitti", hilti, {"--rate", "2"});
  EXPECT_EQ(log.SweepsOn("LIDAR_3D").size(), 40U);
  EXPECT_EQ(log.On("GROUND_TRUTH").size(), 40U);
  EXPECT_EQ(Imported("kitti", RealData("kitti_raw_0005")).SweepsOn("LIDAR_3D").size(), 8U);
  const std::vector<Sweep> vlp16 =
      Imported("kitti", RealData("vlp16_indoor"), {"--lidar", "vlp16"}).SweepsOn("LIDAR_3D");
  ASSERT_EQ(vlp16.size(), 10U);
  const auto known = std::ranges::count_if(vlp16[0].points, [](const SweepPoint& p) { return p.ring >= 0; });
  EXPECT_GT(static_cast<double>(known), 0.99 * static_cast<double>(vlp16[0].points.size()));
}

}  // namespace
}  // namespace lcmslam
