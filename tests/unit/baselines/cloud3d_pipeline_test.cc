#include "baselines/cloud3d_pipeline.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"

namespace lcmslam::cloud3d {
namespace {

SpatialEpisode Episode(double duration_s, bool distortion = false, uint64_t seed = 107) {
  SpatialEpisodeOptions options;
  options.seed = seed;
  options.duration_s = duration_s;
  options.lidar.motion_distortion = distortion;
  options.lidar.range_sigma_m = 0.02;
  return *SpatialEpisode::Create(Hall10World(), options);
}

// Of the positions, with the first poses laid on each other.
double MeanError(const SpatialEpisode& episode, Pipeline& pipeline) {
  const Pose3 T_body0_world = episode.Frame(0).T_world_body.inverse();
  double sum_m = 0.0;
  for (int i = 0; i < episode.num_frames(); ++i) {
    const SpatialFrame frame = episode.Frame(i);
    const Result result = pipeline.Process(frame.sweep);
    EXPECT_EQ(result.status, i == 0 ? Status::kInitializing : Status::kTracking) << i;
    sum_m += (result.T_map_body.translation - (T_body0_world * frame.T_world_body).translation).norm();
  }
  return sum_m / episode.num_frames();
}

TEST(Cloud3dPipeline, TracksAMovingLidar) {
  Pipeline pipeline{Options{}};
  EXPECT_LT(MeanError(Episode(4.0), pipeline), 0.02);
}

// Without deskew a sweep is placed about where the lidar was half a sweep earlier, at about 0.7 m/s.
TEST(Cloud3dPipeline, ReachesTheLastPointOfADistortedSweep) {
  const SpatialEpisode episode = Episode(4.0, true);
  Pipeline pipeline{Options{}}, original{Options{.reach_last_point = false}};
  const double mean_m = MeanError(episode, pipeline), original_m = MeanError(episode, original);
  EXPECT_GT(original_m, 0.01);
  EXPECT_LT(original_m, 0.06);
  EXPECT_LT(mean_m, 0.7 * original_m);
  EXPECT_EQ(pipeline.map().points(), original.map().points());
}

TEST(Cloud3dPipeline, SameSweepsSameBits) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline a{Options{}}, b{Options{}};
  for (int i = 0; i < episode.num_frames(); ++i) {
    const Sweep sweep = episode.Frame(i).sweep;
    const Result x = a.Process(sweep), y = b.Process(sweep);
    EXPECT_EQ(x.T_map_body.translation, y.T_map_body.translation);
    EXPECT_EQ(x.covariance, y.covariance);
  }
  EXPECT_EQ(a.map().points(), b.map().points());
}

TEST(Cloud3dPipeline, TheMapGrowsAfterMotionOnly) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline pipeline{Options{}};
  Sweep sweep = episode.Frame(0).sweep;
  EXPECT_GT(pipeline.Process(sweep).map_points_added, 1000);
  for (int i = 0; i < 5; ++i) {
    sweep.utime += 100'000;
    EXPECT_EQ(pipeline.Process(sweep).map_points_added, 0);
  }
  Pipeline eager{Options{.update_distance_m = 0.0, .update_angle_rad = 0.0}};
  (void)eager.Process(sweep);
  EXPECT_GT(eager.Process(episode.Frame(5).sweep).map_points_added, 0);
}

TEST(Cloud3dPipeline, PredictsWithConstantVelocityOrWhatItIsTold) {
  const SpatialEpisode episode = Episode(4.0);
  Pipeline pipeline{Options{}};
  Result before;
  for (int i = 0; i < 30; ++i) {
    before = std::exchange(before, pipeline.Process(episode.Frame(i).sweep));
  }
  const Result now = pipeline.Process(episode.Frame(30).sweep);
  const BodyState truth = episode.TrueStateAt(episode.Frame(30).sweep.utime);
  EXPECT_NEAR(now.velocity.norm(), truth.velocity_mps.norm(), 0.15);
  const Sweep nothing{.utime = now.utime + 100'000, .points = {}};
  const Result predicted = pipeline.Process(nothing);
  EXPECT_EQ(predicted.status, Status::kSkipped);
  EXPECT_LT((predicted.T_map_body.translation - now.T_map_body.translation - 0.1 * now.velocity).norm(), 0.01);
  const Pose3 hint{{0.5, 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  const Result told = pipeline.Process({.utime = nothing.utime + 100'000, .points = {}}, hint);
  EXPECT_NEAR((told.T_map_body.translation - predicted.T_map_body.translation).norm(), 0.5, 1e-9);
}

TEST(Cloud3dPipeline, SurvivesAwkwardInput) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline pipeline{Options{}};
  EXPECT_EQ(pipeline.Process(Sweep{}).status, Status::kSkipped);
  Sweep sweep = episode.Frame(0).sweep;
  ASSERT_EQ(pipeline.Process(sweep).status, Status::kInitializing);
  EXPECT_EQ(pipeline.Process(sweep).status, Status::kTracking) << "the stamp stands still";
  for (size_t i = 0; i < sweep.points.size(); i += 3) sweep.points[i].x = std::numeric_limits<float>::quiet_NaN();
  for (const int64_t utime : {std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min()}) {
    sweep.utime = utime;
    const Result result = pipeline.Process(sweep);
    EXPECT_EQ(result.status, Status::kTracking);
    EXPECT_LT(result.T_map_body.translation.norm(), 0.01);
  }
  for (SweepPoint& p : sweep.points) p.y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(pipeline.Process(sweep).status, Status::kSkipped);
}

TEST(Cloud3dPipeline, SaysWhenItIsLostAndFindsBack) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline pipeline{Options{}};
  (void)pipeline.Process(episode.Frame(0).sweep);
  const size_t points = pipeline.map().size();
  pipeline.SetPose({{90.0, 0.0, 0.0}, Eigen::Quaterniond::Identity()});
  const Result lost = pipeline.Process(episode.Frame(1).sweep);
  EXPECT_EQ(lost.status, Status::kLost);
  EXPECT_EQ(lost.T_map_body.translation.x(), 90.0);
  EXPECT_EQ(pipeline.map().size(), points);
  pipeline.SetPose({});
  EXPECT_EQ(pipeline.Process(episode.Frame(2).sweep).status, Status::kTracking);
  pipeline.SetPose({{1e300, 0.0, 0.0}, Eigen::Quaterniond::Identity()});
  EXPECT_EQ(pipeline.Process(episode.Frame(3).sweep).status, Status::kLost);
}

TEST(Cloud3dPipeline, ResetForgetsAndLocalizingWritesNothing) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline pipeline{Options{}};
  (void)pipeline.Process(episode.Frame(0).sweep);
  pipeline.Reset();
  EXPECT_EQ(pipeline.map().size(), 0U);
  pipeline.SetLocalizeOnly(true);
  EXPECT_EQ(pipeline.Process(episode.Frame(1).sweep).status, Status::kLost) << "no map";
  EXPECT_EQ(pipeline.map().size(), 0U);
}

TEST(Cloud3dPipeline, TheStopwatchTimesStagesAndNothingElse) {
  const SpatialEpisode episode = Episode(1.0);
  Pipeline timed{Options{}}, untimed{Options{}};
  double now_ms = 0.0;
  timed.SetStopwatch([&] { return now_ms += 1.0; });
  for (int i = 0; i < 3; ++i) {
    const Result a = timed.Process(episode.Frame(i).sweep), b = untimed.Process(episode.Frame(i).sweep);
    EXPECT_EQ(a.T_map_body.translation, b.T_map_body.translation);
    for (const double ms : a.stage_ms) EXPECT_EQ(ms, 1.0);
    for (const double ms : b.stage_ms) EXPECT_EQ(ms, 0.0);
  }
}

TEST(Cloud3dOptions, FaultsAreNamed) {
  EXPECT_EQ(Options{}.Validate(), "");
  EXPECT_EQ(Options{.filter = {.voxel_m = NAN}}.Validate(), "filter.voxel_m: must be 0 or in [0.001, 100]");
  EXPECT_EQ(Options{.icp = {.epsilon = -1.0}}.Validate(), "icp.epsilon: must be in [0, 100]");
  EXPECT_EQ(Options{.map = {.spacing_m = NAN}}.Validate(), "map.spacing_m: must be in [0.001, 100]");
  EXPECT_EQ(Options{.reading_ratio = 2.0}.Validate(), "reading_ratio: must be in (0, 1]");
}

}  // namespace
}  // namespace lcmslam::cloud3d
