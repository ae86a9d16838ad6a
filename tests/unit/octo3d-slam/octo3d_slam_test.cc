#include "octo3d-slam/octo3d_slam.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>
#include <lcmslam/surfel_chunk_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "bus/sweep_chunks.h"
#include "common/config.h"
#include "octo3d-slam/octo3d_slam.pb.h"
#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

namespace fs = std::filesystem;

std::string FileBytes(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

// octo3d-slam log to log on simulated episodes.
class Octo3dSlamTest : public testing::Test {
 protected:
  // Writes what a lidar sends; a share of the chunks never arrives.
  void WriteEpisode(SpatialWorld world, const SpatialEpisodeOptions& options, double lost_share = 0.0) {
    const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(std::move(world), options);
    ASSERT_TRUE(episode);
    std::mt19937_64 random(options.seed);
    const Pose3& T_body_lidar = options.lidar.T_body_lidar;
    input_.Write(options.start_utime, "LIDAR_3D_EXTRINSICS", ExtrinsicsMessage(options.start_utime, T_body_lidar));
    size_t imu = 0;
    for (int i = 0; i < episode->num_frames(); ++i) {
      const SpatialFrame frame = episode->Frame(i);
      for (; imu < episode->imu().size() && episode->imu()[imu].utime <= frame.sweep.utime; ++imu)
        input_.Write(episode->imu()[imu].utime, "IMU", ToMessage(episode->imu()[imu]));
      truth_[frame.sweep.utime] = frame.T_world_body;
      for (const point_cloud_chunk_t& chunk : ToChunks(frame.sweep, i)) {
        ++chunks_;
        if (static_cast<double>(random()) < lost_share * 0x1p64) continue;
        ++arrived_;
        input_.Write(frame.sweep.utime, "LIDAR_3D", chunk);
      }
    }
  }
  static SpatialEpisodeOptions Seconds(double duration_s, uint64_t seed = 11) {
    return {.seed = seed, .duration_s = duration_s};
  }

  // Runs the service; its files come into `folder`. Returns the output log's bytes.
  std::string Run(const std::string& folder, const std::vector<std::string>& assignments = {}) {
    input_.Flush();
    config::Octo3dSlam config;
    for (const std::string& assignment : assignments) SetConfigField(assignment, config);
    const Octo3dSlamOptions options = Octo3dSlam::Complete(config);
    RunOptions run;
    run.log_in = folder_ / "in.lcm";
    run.out = folder_ / folder;
    fs::create_directories(run.out);
    run.log_out = run.out / "out.lcm";
    ServiceContext context(Octo3dSlam::kName, run);
    EXPECT_EQ(RunLogToLog(context, [&](ServiceContext& c) { return std::make_unique<Octo3dSlam>(options, config, c); }),
              ExitCode::kOk);
    missing_ = context.health().missing();
    text_ = context.health().Summary();
    return FileBytes(run.log_out);
  }

  template <LcmMessage M>
  std::vector<M> Messages(const std::string& folder, const std::string& channel) const {
    std::vector<M> messages;
    LogReader reader(folder_ / folder / "out.lcm");
    for (Event event; reader.Next(event);) {
      if (event.channel == channel) messages.push_back(*Decode<M>(event.data));
    }
    return messages;
  }

  // The largest distance from the truth, with the first poses laid on each other; m.
  double LargestError(const std::string& folder) const {
    std::optional<Pose3> T_world_map;
    double largest_m = 0.0;
    for (const pose_t& message : Messages<pose_t>(folder, "OCTO3D_POSE")) {
      const Pose3 T_map_body = DecodePose(Encode(message))->pose;
      const Pose3& T_world_body = truth_.at(message.utime);
      if (!T_world_map) T_world_map = T_world_body * T_map_body.inverse();
      largest_m = std::max(largest_m, ((*T_world_map * T_map_body).translation - T_world_body.translation).norm());
    }
    return largest_m;
  }

  std::vector<int> StatusCounts(const std::string& folder) const {
    std::vector<int> counts(6);
    for (const auto& message : Messages<slam_diagnostics_t>(folder, "OCTO3D_DIAGNOSTICS")) ++counts.at(message.status);
    return counts;
  }

  const TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  LogWriter input_{folder_ / "in.lcm"};
  std::map<int64_t, Pose3> truth_;
  int64_t chunks_ = 0, arrived_ = 0, missing_ = 0;
  std::string text_;
};

TEST_F(Octo3dSlamTest, FollowsTheBodyThroughTheHall) {
  SpatialEpisodeOptions options = Seconds(6.0);
  options.lidar.T_body_lidar = {{0.2, -0.1, 0.4},
                                Eigen::Quaterniond(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()))};
  WriteEpisode(Hall10World(), options);
  Run("out");
  const auto poses = Messages<pose_t>("out", "OCTO3D_POSE");
  ASSERT_EQ(poses.size(), truth_.size());
  EXPECT_LT(Eigen::Map<const Eigen::Vector3d>(poses[0].pos).norm(), 1e-9) << "the body, not the lidar";
  EXPECT_LT(LargestError("out"), 0.03);
  const auto counts = StatusCounts("out");
  EXPECT_EQ(counts[slam_diagnostics_t::INITIALIZING], 1);
  EXPECT_EQ(counts[slam_diagnostics_t::TRACKING] + 1, static_cast<int>(truth_.size()));
  const auto diagnostics = Messages<slam_diagnostics_t>("out", "OCTO3D_DIAGNOSTICS").back();
  EXPECT_EQ(diagnostics.covariance.size(), 36U);
  EXPECT_EQ(diagnostics.stage_ms, std::vector<float>(3)) << "no wall clock in a log";
  for (const char* file : {"_tum.txt", "_map.ot", "_map.bt", "_map.ply", "_map.surfels"})
    EXPECT_GT(fs::file_size(folder_ / "out" / (std::string("octo3d-slam") + file)), 1000U) << file;
}

TEST_F(Octo3dSlamTest, SameBytesTwiceAndWithTwoThreads) {
  SpatialEpisodeOptions options = Seconds(4.0);
  options.imu.rate_hz = 200.0;
  WriteEpisode(Hall10World(), options);
  const std::string first = Run("first", {"channels.imu=IMU"});
  EXPECT_TRUE(first == Run("second", {"channels.imu=IMU"}));
  EXPECT_LT(LargestError("first"), 0.03);
  Run("threads", {"channels.imu=IMU", "threads=2"});  // its log differs: the configuration's hash is in it
  for (const char* file : {"_tum.txt", "_map.ot", "_map.bt", "_map.ply", "_map.surfels"}) {
    const std::string name = std::string("octo3d-slam") + file;
    EXPECT_TRUE(FileBytes(folder_ / "first" / name) == FileBytes(folder_ / "second" / name)) << name;
    EXPECT_TRUE(FileBytes(folder_ / "first" / name) == FileBytes(folder_ / "threads" / name)) << name;
  }
}

TEST_F(Octo3dSlamTest, LivesWithLostChunks) {
  WriteEpisode(Hall10World(), Seconds(8.0), 0.2);
  Run("out");
  EXPECT_LT(LargestError("out"), 0.05);
  EXPECT_NEAR(static_cast<double>(missing_), static_cast<double>(chunks_ - arrived_), 11.0) << "but for the last sweep";
  EXPECT_GT(missing_, chunks_ / 10);
  EXPECT_THAT(text_, testing::HasSubstr("missing"));
}

TEST_F(Octo3dSlamTest, StartsInMotion) {
  SpatialEpisodeOptions options = Seconds(6.0);
  options.carrier.start_in_motion = true;
  WriteEpisode(Hall10World(), options);
  Run("out");
  EXPECT_LT(LargestError("out"), 0.03);
}

TEST_F(Octo3dSlamTest, KnowsThatACorridorHidesMotion) {
  WriteEpisode(Corridor40World(), Seconds(6.0));
  Run("out");
  EXPECT_LT(LargestError("out"), 0.3);
}

// A receiver that obeys surfel_chunk_t's rule ends with the surfels of the PLY file.
TEST_F(Octo3dSlamTest, SurfelsOnTheBusMakeTheMap) {
  WriteEpisode(Hall10World(), Seconds(4.0));
  Run("out");
  size_t surfels = 0;
  for (const auto& chunk : Messages<surfel_chunk_t>("out", "OCTO3D_MAP")) {
    EXPECT_LE(chunk.getEncodedSize(), 60'000);
    surfels += chunk.x.size();
    for (size_t i = 0; i < chunk.x.size(); ++i) {
      EXPECT_NEAR(Eigen::Vector3f(chunk.normal_x[i], chunk.normal_y[i], chunk.normal_z[i]).norm(), 1.0F, 1e-4F);
      EXPECT_GT(chunk.count[i], 0);
    }
  }
  EXPECT_GT(surfels, 1000U);
  EXPECT_LT(surfels, 40'000U) << "only what changed";
}

TEST_F(Octo3dSlamTest, ALoadedMapIsLocalizedIn) {
  WriteEpisode(Hall10World(), Seconds(4.0));
  Run("mapping");
  const std::string map = (folder_ / "mapping" / "octo3d-slam_map.surfels").string();
  Run("again", {"load_map=" + map, "localize_only=true"});
  EXPECT_LT(LargestError("again"), 0.03);
  EXPECT_TRUE(FileBytes(map) == FileBytes(folder_ / "again" / "octo3d-slam_map.surfels")) << "never written into";
}

TEST_F(Octo3dSlamTest, ObeysCommands) {
  slam_command_t command{};
  command.command = slam_command_t::LOAD;
  command.path = (folder_ / "in.lcm").string();
  command.quat[0] = 1.0;
  input_.Write(1, "SLAM_COMMAND", command);
  WriteEpisode(Hall10World(), Seconds(1.0));
  Run("out");
  EXPECT_THAT(text_, testing::HasSubstr("in.lcm: not a surfel map"));
}

TEST(Octo3dSlamConfig, TheShippedFileHoldsTheDefaults) {
  config::Octo3dSlam defaults, shipped;
  (void)Octo3dSlam::Complete(defaults);
  LoadConfig(std::string(LCMSLAM_SOURCE_DIR) + "/services/octo3d-slam/octo3d-slam.pbtxt", shipped);
  EXPECT_EQ(ConfigText(shipped), ConfigText(defaults));
}

TEST(Octo3dSlamConfig, NamesWhatIsWrong) {
  for (const auto& [assignment, field] : std::map<std::string, std::string>{{"map.leaf_m=0", "map.leaf_m"},
                                                                            {"threads=3", "threads"},
                                                                            {"occupancy.max_ray_m=-1", "max_ray_m"},
                                                                            {"channels.lidar=", "channels.lidar"},
                                                                            {"trust.max_gap_s=nan", "max_gap_s"}}) {
    config::Octo3dSlam config;
    SetConfigField(assignment, config);
    try {
      (void)Octo3dSlam::Complete(config);
      ADD_FAILURE() << assignment;
    } catch (const CommandError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(field));
    }
  }
}

}  // namespace
}  // namespace lcmslam
