// `sensor-bridge simulate` of a multi-line lidar, from the episode file to the log.

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <lcmslam/point_cloud_chunk_t.hpp>

#include "bus/messages.h"
#include "bus/sweep_chunks.h"
#include "sensor-bridge/simulate.h"
#include "simulation/spatial_worlds.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

const char* const kEpisode = R"(
seed: 5
duration_s: 1.5
spatial {
  world { name: "bare_room" }
  lidar { mounting { z_m: 0.1 } }
  imu { rate_hz: 100 }
  odometry { rate_hz: 20 }
}
)";

SpatialEpisode SameEpisode() {
  SpatialEpisodeOptions options{.seed = 5, .duration_s = 1.5};
  options.lidar.T_body_lidar.translation.z() = 0.1;
  options.imu.rate_hz = 100.0;
  options.odometry.rate_hz = 20.0;
  return *SpatialEpisode::Create(BareRoomWorld(), options);
}

TEST(SimulateSpatial, SweepsAreThoseOfTheEpisode) {
  const SpatialEpisode episode = SameEpisode();
  const std::vector<Sweep> sweeps = Simulated(kEpisode).SweepsOn("LIDAR_3D");
  ASSERT_EQ(static_cast<int>(sweeps.size()), episode.num_frames());
  for (int i = 0; i < episode.num_frames(); ++i) {
    const Sweep expected = episode.Frame(i).sweep;
    const Sweep& sweep = sweeps[static_cast<size_t>(i)];
    EXPECT_EQ(sweep.utime, expected.utime);
    ASSERT_EQ(sweep.points.size(), expected.points.size());
    for (size_t k = 0; k < sweep.points.size(); ++k) {
      EXPECT_EQ(sweep.points[k].x, expected.points[k].x);
      EXPECT_EQ(sweep.points[k].ring, expected.points[k].ring);
      EXPECT_EQ(sweep.points[k].dt_us, expected.points[k].dt_us);
    }
  }
}

// Live, a burst of a whole sweep would not fit in the receivers' buffers.
TEST(SimulateSpatial, ChunksComeWhenTheirLastPointIsMeasured) {
  for (const char* distortion : {"true", "false"}) {
    SCOPED_TRACE(distortion);
    const Simulated simulated(kEpisode, {"--set", std::string("spatial.lidar.motion_distortion=") + distortion});
    int64_t last_utime = 0;
    std::set<int64_t> last_chunks;
    for (const Event& event : simulated.On("LIDAR_3D")) {
      const point_cloud_chunk_t chunk = *DecodeChunk(event.data);
      EXPECT_LE(event.data.size(), 60'000U);
      EXPECT_LE(event.utime, chunk.utime);
      EXPECT_GT(event.utime, chunk.utime - 100'000);
      EXPECT_GT(event.utime - last_utime, 100'000 / chunk.num_chunks / 2);
      if (event.utime == chunk.utime) last_chunks.insert(chunk.utime);
      last_utime = event.utime;
    }
    EXPECT_GE(last_chunks.size(), 14U);
  }
}

TEST(SimulateSpatial, PublishesTruthImuOdometryAndMounting) {
  const SpatialEpisode episode = SameEpisode();
  const Simulated simulated(kEpisode);
  const std::vector<Event> truth = simulated.On("GROUND_TRUTH");
  ASSERT_EQ(static_cast<int>(truth.size()), episode.num_frames());
  for (int i = 0; i < episode.num_frames(); ++i) {
    const SpatialFrame frame = episode.Frame(i);
    const StampedPose pose = *DecodePose(truth[static_cast<size_t>(i)].data);
    EXPECT_EQ(pose.utime, frame.sweep.utime);
    EXPECT_TRUE((frame.T_world_body.inverse() * pose.pose).translation.isZero(1e-12));
    EXPECT_LT(AngleBetween(frame.T_world_body.rotation, pose.pose.rotation), 1e-7);
  }
  const std::vector<Event> imu = simulated.On("IMU");
  ASSERT_GT(imu.size(), 140U);
  for (size_t i = 0; i < imu.size(); ++i) {
    const ImuSample sample = *DecodeImu(imu[i].data);
    EXPECT_EQ(sample.utime, episode.imu()[i].utime);
    EXPECT_EQ(sample.angular_velocity_radps, episode.imu()[i].angular_velocity_radps);
    EXPECT_EQ(sample.specific_force_mps2, episode.imu()[i].specific_force_mps2);
  }
  const std::vector<Event> odometry = simulated.On("ODOMETRY");
  ASSERT_GT(odometry.size(), 28U);
  for (size_t i = 0; i < odometry.size(); ++i) {
    const StampedPose pose = *DecodePose(odometry[i].data);
    EXPECT_EQ(pose.utime, episode.odometry()[i].utime);
    EXPECT_TRUE((pose.pose.translation - episode.odometry()[i].pose.translation).isZero(1e-12));
  }
  const std::vector<Event> mounting = simulated.On("LIDAR_3D_EXTRINSICS");
  ASSERT_GE(mounting.size(), 1U);
  EXPECT_EQ(DecodeExtrinsics(mounting[0].data)->translation, Eigen::Vector3d(0.0, 0.0, 0.1));
}

TEST(SimulateSpatial, EventsAreInTheOrderOfTime) {
  const Simulated simulated(kEpisode);
  for (size_t i = 1; i < simulated.events.size(); ++i) {
    EXPECT_LE(simulated.events[i - 1].utime, simulated.events[i].utime);
  }
}

TEST(SimulateSpatial, SameSeedSameBytes) {
  const Simulated a(kEpisode);
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_FALSE(a.log.empty());
  EXPECT_EQ(a.log, Simulated(kEpisode).log);
  EXPECT_NE(a.log, Simulated(kEpisode, {"--seed", "6"}).log);
}

TEST(SimulateSpatial, SaysTheCramerRaoBound) {
  const SpatialFrame frame = SameEpisode().Frame(14);
  ASSERT_TRUE(frame.bound.has_value());
  const Eigen::Matrix<double, 6, 1> sigma = frame.bound->diagonal().cwiseSqrt();
  const TemporaryFile csv;
  const Simulated simulated(kEpisode, {"--bound", csv.path()});
  std::ostringstream rows;
  BoundSummary last(&rows);
  last.Add(frame.sweep.utime, PoseBound{sigma.head<3>().norm(), sigma.tail<3>().norm()});
  const std::string row = rows.str().substr(rows.str().find('\n') + 1);
  EXPECT_TRUE(FileBytes(csv.path()).ends_with(row)) << row;
  EXPECT_TRUE(simulated.standard_output.starts_with("Cramer-Rao bound of one scan: position "));
}

}  // namespace
}  // namespace lcmslam
