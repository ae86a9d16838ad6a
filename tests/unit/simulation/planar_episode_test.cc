#include "simulation/planar_episode.h"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

PlanarEpisode Episode(const PlanarEpisodeOptions& options) { return *PlanarEpisode::Create(Room5World(), options); }

bool SameScan(const PlanarScan& a, const PlanarScan& b) {
  const auto same = [](const Beam& p, const Beam& q) {
    return p.range_m == q.range_m && p.angle_rad == q.angle_rad && p.dt_us == q.dt_us;
  };
  return a.utime == b.utime && std::equal(a.beams.begin(), a.beams.end(), b.beams.begin(), b.beams.end(), same);
}

TEST(PlanarEpisode, SameSeedSameScansInAnyOrder) {
  const PlanarEpisodeOptions options{.seed = 7, .duration_s = 5.0, .lidar = {.noise = RangeNoise::Rated()}};
  const PlanarEpisode a = Episode(options);
  const PlanarEpisode b = Episode(options);
  ASSERT_EQ(a.num_frames(), b.num_frames());
  for (int i = 0; i < a.num_frames(); ++i) {
    const int backwards = a.num_frames() - 1 - i;
    EXPECT_TRUE(SameScan(a.Frame(backwards).scan, b.Frame(backwards).scan));
  }
}

TEST(PlanarEpisode, OtherSeedOtherDrive) {
  const PlanarEpisode a = Episode({.seed = 1, .duration_s = 5.0});
  const PlanarEpisode b = Episode({.seed = 2, .duration_s = 5.0});
  EXPECT_FALSE(SameScan(a.Frame(0).scan, b.Frame(0).scan));
}

TEST(PlanarEpisode, ScansFollowTheModelsTiming) {
  const PlanarEpisode episode = Episode({.duration_s = 60.0});
  EXPECT_EQ(episode.num_frames(), 600);
  EXPECT_EQ(episode.Frame(0).scan.utime, 1'066'667);  // 240 of 360 degrees in 66.7 of 100 ms, after the start at 1 s
  EXPECT_EQ(episode.Frame(10).scan.utime, 2'066'667);
}

TEST(PlanarEpisode, RefusesBadOptionsAndWorldsWithoutRoom) {
  EXPECT_FALSE(PlanarEpisode::Create(Room5World(), {.duration_s = NAN}).has_value());
  EXPECT_FALSE(PlanarEpisode::Create(Room5World(), {.drive = {.clearance_m = 3.0}}).has_value());
  EXPECT_FALSE(PlanarEpisode::Create(PlanarWorld({}), {}).has_value());
}

TEST(PlanarEpisode, ValidateNamesTheField) {
  EXPECT_EQ(PlanarEpisodeOptions{}.Validate(), "");
  EXPECT_EQ((PlanarEpisodeOptions{.duration_s = NAN}.Validate()), "duration_s: must be in (0, 1e5]");
  PlanarEpisodeOptions options;
  options.lidar.noise.sigma_m = -1.0;
  EXPECT_EQ(options.Validate(), "lidar.noise.sigma_m: must not be negative");
}

}  // namespace
}  // namespace lcmslam
