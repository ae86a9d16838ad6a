// `sensor-bridge simulate` from the command line to the log it writes.

#include "sensor-bridge/simulate.h"

#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "bus/log_reader.h"
#include "bus/messages.h"
#include "common/command_line.h"
#include "sensor-bridge/simulate_command.h"
#include "simulation/planar_worlds.h"
#include "support/temporary_file.h"

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

std::string Bytes(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

// What `simulate` makes of an episode file.
struct Simulated {
  int exit_code = 0;
  std::string log;
  std::vector<Event> events;
  std::string standard_output;

  explicit Simulated(const std::string& episode, const std::vector<std::string>& options = {}) {
    const TemporaryFile episode_file(episode);
    const TemporaryFile out;
    std::vector<std::string> arguments{"sensor-bridge", "simulate",  "--episode",        episode_file.path(),
                                       "--quiet",       "--log-out", out.path().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    CLI::App app("test", "sensor-bridge");
    std::function<ExitCode()> command;
    AddSimulateCommand(app, command);
    testing::internal::CaptureStdout();
    exit_code = RunCommandLine(app, static_cast<int>(argv.size()), argv.data(), [&] { return command(); });
    standard_output = testing::internal::GetCapturedStdout();
    log = Bytes(out.path());
    if (log.empty()) return;
    LogReader reader(out.path());
    for (Event event; reader.Next(event);) events.push_back(event);
  }
  std::vector<Event> On(const std::string& channel) const {
    std::vector<Event> chosen;
    for (const Event& event : events) {
      if (event.channel == channel) chosen.push_back(event);
    }
    return chosen;
  }
};

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
  BoundSummary expected;
  for (int i = 0; i < episode.num_frames(); ++i) expected.Add(episode.Frame(i));
  EXPECT_EQ(simulated.standard_output, expected.Line() + "\n");
  EXPECT_EQ(Bytes(csv.path()), expected.csv());
}

PlanarFrame FrameWithBound(int64_t utime, double x, double y, double yaw) {
  return {.scan = {.utime = utime, .beams = {}},
          .T_world_body = {},
          .bound = Eigen::Vector3d(x * x, y * y, yaw * yaw).asDiagonal().toDenseMatrix()};
}

TEST(BoundSummary, AveragesScansThatFixThePose) {
  BoundSummary bound;
  EXPECT_EQ(bound.Line(), "Cramer-Rao bound of one scan: none of 0 fixes the pose");
  bound.Add(FrameWithBound(100, 0.003, 0.004, 0.001));
  bound.Add(FrameWithBound(200, 0.006, 0.008, 0.002));
  EXPECT_EQ(bound.Line(), "Cramer-Rao bound of one scan: position 7.500 mm, rotation 1.500 mrad; mean of 2");
  bound.Add({.scan = {.utime = 300, .beams = {}}, .T_world_body = {}, .bound = {}});
  EXPECT_EQ(bound.Line(),
            "Cramer-Rao bound of one scan: position 7.500 mm, rotation 1.500 mrad; mean of 2 of 3, the rest do not fix "
            "the pose");
  EXPECT_EQ(bound.csv(), "utime_us,position_m,yaw_rad\n100,0.005,0.001\n200,0.01,0.002\n300,inf,inf\n");
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
  EXPECT_EQ(Simulated("", {"--seed", "-3"}).exit_code, 2);
  EXPECT_EQ(Simulated("planar { world { map: 'none.yaml' } }").exit_code, 3);
  EXPECT_EQ(Simulated("duration_s: 1", {"--bound", "/nowhere/bound.csv"}).exit_code, 1);
}

TEST(Simulate, EveryShippedEpisodeRuns) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LCMSLAM_SOURCE_DIR "/replay/episodes")) {
    if (entry.path().extension() != ".pbtxt") continue;
    SCOPED_TRACE(entry.path());
    const Simulated simulated(Bytes(entry.path()), {"--set", "duration_s=2"});
    EXPECT_EQ(simulated.exit_code, 0);
    EXPECT_FALSE(simulated.On("LIDAR_2D").empty());
    ++files;
  }
  EXPECT_GT(files, 5);
}

}  // namespace
}  // namespace lcmslam
