#include "simulation/planar_episode.h"

#include <algorithm>
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

// The later world stands within the first, so that the drive is the same.
TEST(PlanarEpisode, TheWorldChangesOnce) {
  const PlanarEpisodeOptions options{.seed = 3, .duration_s = 6.0};
  const PlanarWorld room = Room5World();
  const WorldChange emptied{2.0, PlanarWorld({room.walls().begin(), room.walls().begin() + 4})};
  const PlanarEpisode unchanged = Episode(options);
  const PlanarEpisode changed = *PlanarEpisode::Create(room, options, emptied);
  bool sees_more = false;
  for (int i = 0; i < unchanged.num_frames(); ++i) {
    const PlanarScan before = unchanged.Frame(i).scan, after = changed.Frame(i).scan;
    const bool has_changed = after.utime >= options.start_utime + 2'000'000;
    EXPECT_TRUE(has_changed || SameScan(before, after)) << i;
    sees_more |= has_changed && !SameScan(before, after);
  }
  EXPECT_TRUE(sees_more);
}

TEST(PlanarEpisode, TheRobotKeepsClearOfWhatIsMovedThere) {
  const PlanarEpisodeOptions options{.seed = 3, .duration_s = 20.0};
  const PlanarWorld later(BoxOutline({2.5, 2.5}, 1.0, 1.0));
  const PlanarEpisode episode = *PlanarEpisode::Create(Room5World(), options, WorldChange{10.0, later});
  for (int i = 0; i < episode.num_frames(); ++i) {
    const Eigen::Vector2d p = episode.Frame(i).T_world_body.translation();
    EXPECT_GE(std::min(later.Distance(p), episode.world().Distance(p)), options.drive.clearance_m - 1e-6);
  }
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
