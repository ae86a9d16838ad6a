#include "octo3d/pipeline.h"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "octo3d/map_file.h"
#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"

namespace lcmslam::octo3d {
namespace {

SpatialEpisode Episode(const char* world, double duration_s, bool distortion = true, uint64_t seed = 1007) {
  SpatialEpisodeOptions options;
  options.seed = seed;
  options.duration_s = duration_s;
  options.lidar.motion_distortion = distortion;
  return *SpatialEpisode::Create(*NamedSpatialWorld(world), options);
}

// The estimate's error at each sweep, in the frame of the first body pose.
double WorstError(const SpatialEpisode& episode, Pipeline& pipeline) {
  const Pose3 T_body0_world = episode.Frame(0).T_world_body.inverse();
  double worst_m = 0.0;
  for (int i = 0; i < episode.num_frames(); ++i) {
    const SpatialFrame frame = episode.Frame(i);
    const Result result = pipeline.Process(frame.sweep);
    EXPECT_EQ(result.status, i == 0 ? SweepStatus::kStarted : SweepStatus::kTracking) << i;
    EXPECT_EQ(result.utime, frame.sweep.utime);
    worst_m =
        std::max(worst_m, (result.T_map_body.translation - (T_body0_world * frame.T_world_body).translation).norm());
  }
  return worst_m;
}

TEST(Pipeline, TracksAMovingLidar) {
  Pipeline pipeline{Options{}};
  EXPECT_LT(WorstError(Episode("hall10", 4.0), pipeline), 0.04);
}

// Sweeps of a lidar at rest differ by their noise: that is no motion.
TEST(Pipeline, StaysWhereItBeganAtRest) {
  double sum_m = 0.0;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Pipeline pipeline{Options{}};
    sum_m += WorstError(Episode("hall10", 0.2, true, seed), pipeline);
  }
  EXPECT_LT(sum_m / 5.0, 0.0015);
}

// The first sweep alone does not tell that it is smeared over the way the lidar went meanwhile.
TEST(Pipeline, BeginsAnewWhenTheFirstSweepWasInMotion) {
  SpatialEpisodeOptions options;
  options.seed = 4;
  options.duration_s = 2.0;
  options.carrier.start_in_motion = true;
  const SpatialEpisode episode = *SpatialEpisode::Create(Hall10World(), options);
  const BodyState start = episode.TrueStateAt(options.start_utime);
  ASSERT_GT(start.velocity_mps.norm(), 0.3);
  Pipeline pipeline{Options{}};
  EXPECT_LT(WorstError(episode, pipeline), 0.02);
  Pipeline other{Options{}};
  EXPECT_FALSE(other.Process(episode.Frame(0).sweep).began_anew);
  EXPECT_TRUE(other.Process(episode.Frame(1).sweep).began_anew);
  EXPECT_FALSE(other.Process(episode.Frame(2).sweep).began_anew);
}

TEST(Pipeline, TracksSweepsWithoutTimes) {
  Pipeline pipeline{Options{}};
  EXPECT_LT(WorstError(Episode("hall10", 3.0, false), pipeline), 0.03);
}

TEST(Pipeline, TakesInWhatMotionShowsAndNothingAtRest) {
  const SpatialEpisode episode = Episode("hall10", 4.0, false);
  Pipeline pipeline{Options{}};
  EXPECT_TRUE(pipeline.Process(episode.Frame(0).sweep).inserted);
  Sweep again = episode.Frame(0).sweep;
  for (int i = 1; i < 14; ++i) {
    again.utime += 100'000;
    const Result result = pipeline.Process(again);
    EXPECT_EQ(result.status, SweepStatus::kTracking);
    EXPECT_EQ(result.inserted, i < 10) << "a young map gains at rest too";
  }
  Pose3 T_map_inserted;
  for (int i = 0; i < episode.num_frames(); ++i) {
    Sweep sweep = episode.Frame(i).sweep;
    sweep.utime = again.utime + 100'000 * (i + 1);
    const Result result = pipeline.Process(sweep);
    const Pose3 motion = T_map_inserted.inverse() * result.T_map_body;
    EXPECT_EQ(result.inserted,
              motion.translation.norm() >= pipeline.options().update_distance_m ||
                  AngleBetween(motion.rotation, Eigen::Quaterniond::Identity()) >= pipeline.options().update_angle_rad);
    if (result.inserted) T_map_inserted = result.T_map_body;
  }
  EXPECT_GT(T_map_inserted.translation.norm(), 0.0);
}

TEST(Pipeline, SaysWhatACorridorDoesNotShow) {
  // Two walls, floor and ceiling without end.
  Sweep sweep{.utime = 0, .points = {}};
  for (int i = 0; i < 40000; ++i) {
    const float along = -8.0F + 0.0004F * i, across = -1.0F + 0.002F * (i * 7 % 1000);
    sweep.points.push_back(i % 2 == 0 ? SweepPoint{.x = along, .y = i % 4 == 0 ? 1.03F : -1.03F, .z = across}
                                      : SweepPoint{.x = along, .y = across, .z = i % 4 == 1 ? 1.07F : -1.07F});
  }
  Pipeline pipeline{Options{}};
  for (int i = 1; i < 4; ++i) {
    sweep.utime = 100000 * i;
    const Result result = pipeline.Process(sweep);
    if (i == 1) continue;
    ASSERT_EQ(result.status, SweepStatus::kTracking);
    ASSERT_EQ(result.unobservable.cols(), 1);
    EXPECT_GT(std::abs(result.unobservable(0, 0)), 0.99);
    EXPECT_GT(result.covariance(0, 0), 10.0 * result.covariance(1, 1));
  }
}

// Level beams meet the walls of a bare room only, whose surfels are tilted a little by noise.
TEST(Pipeline, DoesNotTakeNoiseOfWallsForHeight) {
  for (const uint64_t seed : {1001, 1011}) {
    SCOPED_TRACE(seed);
    const SpatialEpisode episode = Episode("bare_room", 1.0, true, seed);  // at rest
    Pipeline pipeline{Options{}};
    (void)pipeline.Process(episode.Frame(0).sweep);
    for (int i = 1; i < episode.num_frames(); ++i) {
      const Result result = pipeline.Process(episode.Frame(i).sweep);
      ASSERT_EQ(result.status, SweepStatus::kTracking);
      ASSERT_GE(result.unobservable.cols(), 1);
      EXPECT_GT(std::abs(result.unobservable(2, 0)), 0.99);
    }
  }
}

TEST(Pipeline, SameInputSameBytes) {
  const SpatialEpisode episode = Episode("hall10", 1.0);
  std::string maps[2];
  for (std::string& bytes : maps) {
    Pipeline pipeline{Options{}};
    for (int i = 0; i < episode.num_frames(); ++i) (void)pipeline.Process(episode.Frame(i).sweep);
    std::ostringstream out;
    WriteMap(pipeline.map(), out);
    bytes = out.str();
  }
  EXPECT_EQ(maps[0], maps[1]);
}

TEST(Pipeline, KeepsDoubtfulSweepsOutOfTheMap) {
  const SpatialEpisode episode = Episode("hall10", 1.0);
  Pipeline pipeline{Options{}};
  for (int i = 0; i < 5; ++i) (void)pipeline.Process(episode.Frame(i).sweep);
  Sweep junk = episode.Frame(5).sweep;
  unsigned state = 1;
  for (SweepPoint& p : junk.points) {
    for (float* c : {&p.x, &p.y, &p.z})
      *c = static_cast<float>((state = state * 1664525U + 1013904223U) >> 8) / 1e6F - 8.0F;
  }
  const uint32_t revision = pipeline.map().revision();
  const Result doubtful = pipeline.Process(junk);
  EXPECT_EQ(doubtful.status, SweepStatus::kDoubtful);
  EXPECT_FALSE(doubtful.inserted);
  EXPECT_EQ(pipeline.map().revision(), revision);
  EXPECT_EQ(pipeline.Process(episode.Frame(6).sweep).status, SweepStatus::kTracking) << "found again";
}

TEST(Pipeline, LocalizesInALoadedMap) {
  const SpatialEpisode episode = Episode("hall10", 3.0);
  Pipeline mapper{Options{}};
  for (int i = 0; i < episode.num_frames(); ++i) (void)mapper.Process(episode.Frame(i).sweep);
  std::stringstream file;
  WriteMap(mapper.map(), file);

  Options options;
  options.localize_only = true;
  Pipeline localizer(options);
  ReadMapResult loaded = ReadMap(file);
  ASSERT_TRUE(loaded.map) << loaded.error;
  localizer.SetMap(std::move(*loaded.map));
  const Pose3 T_world_body0 = episode.Frame(0).T_world_body;
  const SpatialFrame frame = episode.Frame(20);
  Pose3 guess = T_world_body0.inverse() * frame.T_world_body;
  guess.translation += Eigen::Vector3d(0.15, -0.1, 0.05);
  localizer.SetPose(guess);
  const Result result = localizer.Process(frame.sweep);
  EXPECT_EQ(result.status, SweepStatus::kTracking);
  EXPECT_FALSE(result.inserted);
  EXPECT_LT((result.T_map_body.translation - (T_world_body0.inverse() * frame.T_world_body).translation).norm(), 0.05);
}

TEST(Pipeline, SurvivesAwkwardInput) {
  Pipeline pipeline{Options{}};
  EXPECT_EQ(pipeline.Process(Sweep{}).status, SweepStatus::kNoPoints);
  const SpatialEpisode episode = Episode("hall10", 1.0);
  (void)pipeline.Process(episode.Frame(0).sweep);
  EXPECT_EQ(pipeline.Process(episode.Frame(0).sweep).status, SweepStatus::kStale) << "the stamp stands still";
  EXPECT_EQ(pipeline.Process(Sweep{.utime = episode.Frame(1).sweep.utime, .points = {}}).status,
            SweepStatus::kNoPoints);
  Sweep sweep = episode.Frame(2).sweep;
  for (size_t i = 0; i < sweep.points.size(); i += 3) sweep.points[i].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(pipeline.Process(sweep).status, SweepStatus::kTracking);
  sweep.utime = std::numeric_limits<int64_t>::max();
  EXPECT_TRUE(pipeline.Process(sweep).T_map_body.IsFinite()) << "after a jump in time";
  sweep.utime = std::numeric_limits<int64_t>::min();
  EXPECT_EQ(pipeline.Process(sweep).status, SweepStatus::kStale);
}

TEST(Pipeline, ResetStartsAfresh) {
  const SpatialEpisode episode = Episode("hall10", 1.0);
  Pipeline pipeline{Options{}};
  (void)pipeline.Process(episode.Frame(4).sweep);
  pipeline.Reset();
  EXPECT_EQ(pipeline.map().num_cells(), 0U);
  EXPECT_EQ(pipeline.Process(episode.Frame(0).sweep).status, SweepStatus::kStarted) << "an older stamp is welcome";
}

TEST(Pipeline, TakesARotationHint) {
  // The head turns by 0.6 rad between two sweeps a second apart.
  const SpatialEpisode episode = Episode("hall10", 3.0, false);
  Pipeline pipeline{Options{}};
  Sweep sweep = episode.Frame(3).sweep;
  (void)pipeline.Process(sweep);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()));
  for (SweepPoint& p : sweep.points) {
    const Eigen::Vector3f turned = turn.conjugate().cast<float>() * Eigen::Vector3f(p.x, p.y, p.z);
    p.x = turned.x(), p.y = turned.y(), p.z = turned.z();
  }
  sweep.utime += 1000000;
  const Result result = pipeline.Process(sweep, {.rotation = turn, .odometry = {}});
  EXPECT_EQ(result.status, SweepStatus::kTracking);
  EXPECT_LT(AngleBetween(result.T_map_body.rotation, turn), 0.01);
  EXPECT_LT(result.T_map_body.translation.norm(), 0.02);
}

TEST(Options, DefaultsAreValidAndFaultsAreNamed) {
  EXPECT_EQ(Options{}.Validate(), "");
  Options options;
  options.map.leaf_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(options.Validate(), "map.leaf_m: must be in [0.01, 10]");
  options = {};
  options.patches.max_range_m = 0.2;
  EXPECT_EQ(options.Validate(), "patches.max_range_m: must exceed min_range_m");
  options = {};
  options.trust.min_inlier_ratio = 1.5;
  EXPECT_EQ(options.Validate(), "trust.min_inlier_ratio: must be in [0, 1]");
}

}  // namespace
}  // namespace lcmslam::octo3d
