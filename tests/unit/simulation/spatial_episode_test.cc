#include "simulation/spatial_episode.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "simulation/spatial_worlds.h"
#include "unit/simulation/cast_rays.h"

namespace lcmslam {
namespace {

SpatialEpisode Episode(const SpatialEpisodeOptions& options) {
  return *SpatialEpisode::Create(BareRoomWorld(), options);
}

bool SameSweep(const Sweep& a, const Sweep& b) {
  const auto same = [](const SweepPoint& p, const SweepPoint& q) {
    return p.x == q.x && p.y == q.y && p.z == q.z && p.intensity == q.intensity && p.ring == q.ring &&
           p.dt_us == q.dt_us;
  };
  return a.utime == b.utime && std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same);
}

TEST(SpatialEpisode, SameSeedSameSweepsInAnyOrder) {
  const SpatialEpisodeOptions options{.seed = 7, .duration_s = 1.0, .imu = {.rate_hz = 100.0}};
  const SpatialEpisode a = Episode(options);
  const SpatialEpisode b = Episode(options);
  ASSERT_EQ(a.num_frames(), 10);
  for (int i = 0; i < a.num_frames(); ++i) {
    EXPECT_TRUE(SameSweep(a.Frame(i).sweep, b.Frame(i).sweep));
    const int backwards = a.num_frames() - 1 - i;
    EXPECT_TRUE(SameSweep(a.Frame(backwards).sweep, b.Frame(backwards).sweep));
  }
  EXPECT_EQ(a.imu().back().angular_velocity_radps, b.imu().back().angular_velocity_radps);
}

TEST(SpatialEpisode, OtherSeedOtherJourney) {
  const SpatialEpisode a = Episode({.seed = 1, .duration_s = 1.0});
  const SpatialEpisode b = Episode({.seed = 2, .duration_s = 1.0});
  EXPECT_FALSE(SameSweep(a.Frame(0).sweep, b.Frame(0).sweep));
}

TEST(SpatialEpisode, TruthBelongsToTheSweepsTime) {
  const SpatialEpisode episode = Episode({.duration_s = 60.0, .carrier = {.start_in_motion = true}});
  ASSERT_EQ(episode.num_frames(), 600);
  for (const int i : {0, 99, 599}) {
    const SpatialFrame frame = episode.Frame(i);
    EXPECT_LT(std::abs(frame.sweep.utime - (1'000'000 + 100'000 * (i + 1))), 60) << "last shot of the turn";
    const Pose3 expected = episode.motion().PoseAt(1e-6 * static_cast<double>(frame.sweep.utime - 1'000'000));
    EXPECT_EQ(frame.T_world_body.translation, expected.translation);
    EXPECT_EQ(frame.T_world_body.rotation.coeffs(), expected.rotation.coeffs());
  }
}

// The options of one part leave the random draws of the others alone.
TEST(SpatialEpisode, NoiseAndDropoutsDoNotChangeTheJourney) {
  const SpatialEpisode plain = Episode({.duration_s = 1.0, .lidar = {.range_sigma_m = 0.0}});
  const SpatialEpisode noisy = Episode(
      {.duration_s = 1.0, .lidar = {.range_sigma_m = 0.05, .dropout_probability = 0.1}, .imu = {.rate_hz = 100}});
  EXPECT_EQ(plain.Frame(9).T_world_body.translation, noisy.Frame(9).T_world_body.translation);
}

TEST(SpatialEpisode, RefusesBadOptionsAndWorldsWithoutRoom) {
  EXPECT_FALSE(SpatialEpisode::Create(BareRoomWorld(), {.duration_s = NAN}).has_value());
  EXPECT_FALSE(SpatialEpisode::Create(BareRoomWorld(), {.carrier = {.clearance_m = 3.0}}).has_value());
}

TEST(SpatialEpisode, ValidateNamesTheField) {
  EXPECT_EQ(SpatialEpisodeOptions{}.Validate(), "");
  EXPECT_EQ(SpatialEpisodeOptions{.duration_s = NAN}.Validate(), "duration_s: must be in (0, 1e5]");
  SpatialEpisodeOptions options;
  options.lidar.range_sigma_m = -1.0;
  EXPECT_EQ(options.Validate(), "lidar.range_sigma_m: must not be negative");
  options = {.carrier = {.clearance_m = -1.0}};
  EXPECT_EQ(options.Validate(), "carrier.clearance_m: must be in (0, 10]");
  options = {.imu = {.rate_hz = -1.0}};
  EXPECT_EQ(options.Validate(), "imu.rate_hz: must be in 0..1000");
}

TEST(SpatialWorlds, ByName) {
  for (const std::string_view name : {"hall10", "bare_room", "corridor40"}) {
    const std::optional<SpatialWorld> world = NamedSpatialWorld(name);
    ASSERT_TRUE(world.has_value()) << name;
    EXPECT_GT(world->Distance(world->p_inside(), 5.0), 0.9) << name;
  }
  EXPECT_FALSE(NamedSpatialWorld("hall11").has_value());
}

// The hall is closed but for its window: rays from the middle leave only through it.
TEST(SpatialWorlds, HallIsClosedButForItsWindow) {
  const SpatialWorld world = Hall10World();
  std::vector<TestRay> rays;
  for (int i = 0; i < 20'000; ++i) {  // Fibonacci sphere
    const double z = 1.0 - (2.0 * i + 1.0) / 20'000.0;
    const double angle_rad = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(r * std::cos(angle_rad), r * std::sin(angle_rad), z);
    rays.push_back({world.p_inside().cast<float>(), direction.cast<float>()});
  }
  const std::vector<TestHit> hits = CastRays(world, rays);
  int out = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (std::isfinite(hits[i].range_m)) continue;
    ++out;
    ASSERT_GT(rays[i].direction.x(), 0.0F);
    const Eigen::Vector3f on_wall =
        rays[i].origin + (10.0F - rays[i].origin.x()) / rays[i].direction.x() * rays[i].direction;
    EXPECT_LT(std::abs(on_wall.y() - 4.0F), 0.8F);
    EXPECT_GT(on_wall.z(), 0.9F);
    EXPECT_LT(on_wall.z(), 2.6F);
  }
  EXPECT_GT(out, 50);
}

}  // namespace
}  // namespace lcmslam
