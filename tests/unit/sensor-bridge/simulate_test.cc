// `sensor-bridge simulate` from the command line to the log it writes.

#include "sensor-bridge/simulate.h"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bus/messages.h"
#include "simulation/planar_worlds.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

const char* const kEpisode = R"(
seed: 7
duration_s: 5
planar {
  lidar { noise_level: LOW mounting { x_m: 0.2 yaw_rad: 0.5 } }
  odometry { rate_hz: 20 }
}
)";

PlanarEpisode SameEpisode() {
  return *PlanarEpisode::Create(Room5World(),
                                {.seed = 7,
                                 .duration_s = 5.0,
                                 .lidar = {.noise = RangeNoise::Low(), .T_body_lidar = Pose2(0.2, 0.0, 0.5)},
                                 .odometry = {.rate_hz = 20.0}});
}

TEST(Simulate, PublishesScansAsSimulated) {
  const PlanarEpisode episode = SameEpisode();
  const std::vector<Event> scans = Simulated(kEpisode).On("LIDAR_2D");
  ASSERT_EQ(static_cast<int>(scans.size()), episode.num_frames());
  for (int i = 0; i < episode.num_frames(); ++i) {
    const PlanarScan expected = episode.Frame(i).scan;
    const PlanarScan scan = *DecodeScan(scans[static_cast<size_t>(i)].data);
    EXPECT_EQ(scans[static_cast<size_t>(i)].utime, expected.utime);
    EXPECT_EQ(scan.utime, expected.utime);
    ASSERT_EQ(scan.beams.size(), expected.beams.size());
    for (size_t k = 0; k < scan.beams.size(); ++k) {
      EXPECT_EQ(scan.beams[k].range_m, expected.beams[k].range_m);
      EXPECT_EQ(scan.beams[k].angle_rad, expected.beams[k].angle_rad);
      EXPECT_EQ(scan.beams[k].dt_us, expected.beams[k].dt_us);
    }
  }
}

void ExpectPose(const Event& event, int64_t utime, const Pose2& expected) {
  const StampedPose pose = *DecodePose(event.data);
  EXPECT_EQ(event.utime, utime);
  EXPECT_EQ(pose.utime, utime);
  EXPECT_TRUE((expected.inverse() * ToPose2(pose.pose)).Log().isZero(1e-12));
}

TEST(Simulate, PublishesTruthOdometryAndMounting) {
  const PlanarEpisode episode = SameEpisode();
  const Simulated simulated(kEpisode);
  const std::vector<Event> truth = simulated.On("GROUND_TRUTH");
  ASSERT_EQ(static_cast<int>(truth.size()), episode.num_frames());
  for (int i = 0; i < episode.num_frames(); ++i) {
    const PlanarFrame frame = episode.Frame(i);
    ExpectPose(truth[static_cast<size_t>(i)], frame.scan.utime, frame.T_world_body);
  }
  const std::vector<Event> odometry = simulated.On("ODOMETRY");
  ASSERT_GT(odometry.size(), 95U);
  for (size_t i = 0; i < odometry.size(); ++i) {
    ExpectPose(odometry[i], episode.odometry()[i].utime, episode.odometry()[i].T_odom_body);
  }
  const std::vector<Event> mounting = simulated.On("LIDAR_2D_EXTRINSICS");
  ASSERT_GE(mounting.size(), 4U);
  for (const Event& event : mounting) {
    EXPECT_TRUE(ToPose2(*DecodeExtrinsics(event.data)).translation().isApprox(Eigen::Vector2d(0.2, 0.0)));
    EXPECT_NEAR(ToPose2(*DecodeExtrinsics(event.data)).yaw(), 0.5, 1e-12);
  }
}

TEST(Simulate, EventsAreInTheOrderOfTime) {
  const Simulated simulated(kEpisode);
  for (size_t i = 1; i < simulated.events.size(); ++i) {
    EXPECT_LE(simulated.events[i - 1].utime, simulated.events[i].utime);
  }
}

TEST(Simulate, SameSeedSameBytes) {
  const Simulated a(kEpisode);
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_FALSE(a.log.empty());
  EXPECT_EQ(a.log, Simulated(kEpisode).log);
  EXPECT_EQ(a.log, Simulated(kEpisode, {"--seed", "7"}).log);
  EXPECT_NE(a.log, Simulated(kEpisode, {"--seed", "8"}).log);
  EXPECT_EQ(Simulated(kEpisode, {"--seed", "8"}).log, Simulated(kEpisode, {"--set", "seed=8"}).log);
}

TEST(Simulate, SaysTheCramerRaoBound) {
  const TemporaryFile csv;
  const Simulated simulated(kEpisode, {"--bound", csv.path()});
  const PlanarEpisode episode = SameEpisode();
  std::ostringstream rows;
  BoundSummary expected(&rows);
  for (int i = 0; i < episode.num_frames(); ++i) {
    const PlanarFrame frame = episode.Frame(i);
    const Eigen::Vector3d sigma = frame.bound->diagonal().cwiseSqrt();
    expected.Add(frame.scan.utime, PoseBound{sigma.head<2>().norm(), sigma.z()});
  }
  EXPECT_EQ(simulated.standard_output, expected.Line() + "\n");
  EXPECT_EQ(FileBytes(csv.path()), rows.str());
}

TEST(BoundSummary, AveragesScansThatFixThePose) {
  std::ostringstream rows;
  BoundSummary bound(&rows);
  EXPECT_EQ(bound.Line(), "Cramer-Rao bound of one scan: none of 0 fixes the pose");
  bound.Add(100, PoseBound{0.005, 0.001});
  bound.Add(200, PoseBound{0.010, 0.002});
  EXPECT_EQ(bound.Line(), "Cramer-Rao bound of one scan: position 7.500 mm, rotation 1.500 mrad; mean of 2");
  bound.Add(300, {});
  EXPECT_EQ(bound.Line(),
            "Cramer-Rao bound of one scan: position 7.500 mm, rotation 1.500 mrad; mean of 2 of 3, the rest do not fix "
            "the pose");
  EXPECT_EQ(rows.str(), "utime_us,position_m,rotation_rad\n100,0.005,0.001\n200,0.01,0.002\n300,inf,inf\n");
}

TEST(Simulate, PrintsTheEffectiveEpisode) {
  const Simulated printed(kEpisode, {"--print-config"});
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_TRUE(printed.log.empty());
  EXPECT_EQ(Simulated(printed.standard_output, {"--print-config"}).standard_output, printed.standard_output);
  EXPECT_EQ(Simulated(printed.standard_output).log, Simulated(kEpisode).log);
}

TEST(Simulate, RefusesBadEpisodes) {
  EXPECT_EQ(Simulated("frobnicate: 1").exit_code, 2);
  EXPECT_EQ(Simulated("seed: 1 seed: 2").exit_code, 2);
  EXPECT_EQ(Simulated("duration_s: nan").exit_code, 2);
  EXPECT_EQ(Simulated("planar {} spatial {}").exit_code, 2);
  EXPECT_EQ(Simulated("", {"--seed", "-3"}).exit_code, 2);
  EXPECT_EQ(Simulated("", {"--seed", "99999999999999999999"}).exit_code, 2) << "no other seed in its place";
  EXPECT_EQ(Bridge({"simulate", "--episode", "/tmp"}), 2) << "a folder is no empty file";
  EXPECT_EQ(Simulated("planar { world { map: 'none.yaml' } }").exit_code, 3);
  const Simulated no_bound("duration_s: 1", {"--bound", "/nowhere/bound.csv"});
  EXPECT_EQ(no_bound.exit_code, 1);
  EXPECT_TRUE(no_bound.log.empty()) << "said before it is simulated";
}

TEST(Simulate, EveryShippedEpisodeRuns) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LCMSLAM_SOURCE_DIR "/replay/episodes")) {
    if (entry.path().extension() != ".pbtxt") continue;
    SCOPED_TRACE(entry.path());
    BridgeRun simulated;
    simulated.Run({"simulate", "--episode", entry.path().string(), "--set", "duration_s=0.5"});
    EXPECT_EQ(simulated.exit_code, 0);
    EXPECT_FALSE(simulated.On("GROUND_TRUTH").empty());
    EXPECT_NE(simulated.On("LIDAR_2D").empty(), simulated.On("LIDAR_3D").empty());
    ++files;
  }
  EXPECT_GT(files, 5);
}

}  // namespace
}  // namespace lcmslam
