#include "sdf2d/pipeline.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

std::vector<PlanarFrame> Drive(const PlanarEpisodeOptions& options) {
  const auto episode = PlanarEpisode::Create(Room5World(), options);
  std::vector<PlanarFrame> frames;
  for (int i = 0; i < episode->num_frames(); ++i) frames.push_back(episode->Frame(i));
  return frames;
}

PlanarEpisodeOptions Episode(uint64_t seed, const RangeNoise& noise, bool distortion, double duration_s) {
  return {.seed = seed, .duration_s = duration_s, .lidar = {.noise = noise, .motion_distortion = distortion}};
}

Options StartingAt(const Pose2& T_map_body) { return {.T_map_body_initial = T_map_body}; }

// Mean distance to the truth; the pipeline starts at the true pose.
double MeanError(const std::vector<PlanarFrame>& frames) {
  Pipeline pipeline(StartingAt(frames.front().T_world_body));
  double sum = 0.0;
  for (const PlanarFrame& frame : frames) {
    const Result result = pipeline.Process(frame.scan);
    sum += (result.T_map_body.translation() - frame.T_world_body.translation()).norm();
  }
  return sum / static_cast<double>(frames.size());
}

// Generous against the medians of the benchmark: these must hold for every seed.
TEST(Pipeline, FollowsASimulatedRobot) {
  for (uint64_t seed = 1001; seed < 1004; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_LT(MeanError(Drive(Episode(seed, RangeNoise::None(), false, 20.0))), 0.002);
    EXPECT_LT(MeanError(Drive(Episode(seed, RangeNoise::Low(), false, 20.0))), 0.004);
    EXPECT_LT(MeanError(Drive(Episode(seed, RangeNoise::Low(), true, 20.0))), 0.008);
    EXPECT_LT(MeanError(Drive(Episode(seed, RangeNoise::Rated(), false, 20.0))), 0.04);
    EXPECT_LT(MeanError(Drive(Episode(seed, RangeNoise::Rated(), true, 20.0))), 0.06);
  }
}

// A small robot: a second at rest, then from rest to 3 rad/s at once and back, one turn in three the other way.
struct SuddenTurns {
  static constexpr double kStart_s = 1.0, kPeriod_s = 1.13, kTurn_s = 0.61;  // beginning anywhere within a scan

  static double Since_s(int64_t utime) { return 1e-6 * static_cast<double>(utime) - kStart_s; }
  static bool IsTurning(int64_t utime) {
    return Since_s(utime) > 0.0 && std::fmod(Since_s(utime), kPeriod_s) < kTurn_s;
  }
  static Pose2 At(int64_t utime) {
    const double since_s = std::max(0.0, Since_s(utime));
    const double turns = std::floor(since_s / kPeriod_s);
    const bool back = std::fmod(turns, 3.0) == 2.0;
    const double before_s = kTurn_s * (turns - 2.0 * std::floor(turns / 3.0));
    const double now_s = std::min(std::fmod(since_s, kPeriod_s), kTurn_s);
    return Pose2(2.5, 1.2, 3.0 * (before_s + (back ? -now_s : now_s)));
  }
};

// Under a lidar that turns slowly. A turn that begins or ends within a scan may mislead it, but not the next one.
TEST(Pipeline, FollowsSuddenTurns) {
  PlanarLidarOptions lidar{.model = RplidarA2(), .noise = RangeNoise::Low()};
  lidar.model.turn_s = 0.15;
  constexpr int64_t kScan_us = 150'000;
  const PlanarWorld world = Room5World();
  for (uint64_t seed = 1; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    Pipeline pipeline(StartingAt(SuddenTurns::At(0)));
    int steady = 0;
    for (int64_t utime = kScan_us; utime < 20'000'000; utime += kScan_us) {
      const Result result = pipeline.Process(SimulateScan(world, {}, SuddenTurns::At, utime, lidar, rng).scan);
      const Pose2 error = SuddenTurns::At(utime).inverse() * result.T_map_body;
      EXPECT_NE(result.status, Status::kLost) << utime;
      if (SuddenTurns::IsTurning(utime) != SuddenTurns::IsTurning(utime - kScan_us)) continue;
      EXPECT_LT(error.translation().norm(), 0.06) << utime;
      EXPECT_LT(std::abs(error.yaw()), 0.15) << utime;
      ++steady;
    }
    EXPECT_GT(steady, 60);
  }
}

TEST(Pipeline, ReportsWhatItDid) {
  const auto frames = Drive(Episode(1005, RangeNoise::Low(), false, 3.0));
  Pipeline pipeline({});
  double clock_ms = 0.0;
  pipeline.SetStopwatch([&clock_ms] { return clock_ms += 1.0; });
  Result result = pipeline.Process(frames[0].scan);
  EXPECT_EQ(result.status, Status::kInitializing);
  EXPECT_EQ(result.T_map_body.Log().norm(), 0.0) << "the map's frame is the first pose";
  for (size_t i = 1; i < frames.size(); ++i) {
    result = pipeline.Process(frames[i].scan);
    EXPECT_EQ(result.status, Status::kTracking);
    EXPECT_EQ(result.utime, frames[i].scan.utime);
    EXPECT_GE(result.iterations, 1);
    EXPECT_GT(result.covariance(0, 0), 0.0);
    for (const double ms : result.stage_ms) EXPECT_GT(ms, 0.0);
  }
  EXPECT_GT(result.inlier_ratio, 0.9);
  EXPECT_NEAR(result.residual_rms_m, 0.01, 0.003);
  EXPECT_NEAR(result.range_sigma_m, 0.01, 0.001);
  EXPECT_LT((result.twist_body - frames.back().twist_body).norm(), 0.15);
}

TEST(Pipeline, MountingMovesTheBodyNotTheLidar) {
  const auto frames = Drive(Episode(1006, RangeNoise::None(), false, 5.0));
  const Pose2 T_body_lidar(0.3, -0.1, std::numbers::pi / 2);
  Pipeline plain({});
  Pipeline mounted({.T_body_lidar = T_body_lidar});
  for (const PlanarFrame& frame : frames) {
    const Pose2 T_lidar0_lidar = plain.Process(frame.scan).T_map_body;
    const Pose2 T_map_body = mounted.Process(frame.scan).T_map_body;
    const Pose2 difference = (T_body_lidar * T_lidar0_lidar * T_body_lidar.inverse()).inverse() * T_map_body;
    EXPECT_LT(difference.Log().norm(), 0.002);
  }
}

TEST(Pipeline, SameScansSameBytes) {
  const auto frames = Drive(Episode(1007, RangeNoise::Rated(), true, 5.0));
  Pipeline a({}), b({});
  double ms = 0.0;
  b.SetStopwatch([&ms] { return ms += 0.3; });
  for (const PlanarFrame& frame : frames) {
    const Result ra = a.Process(frame.scan), rb = b.Process(frame.scan);
    ASSERT_EQ(std::memcmp(&ra.T_map_body, &rb.T_map_body, sizeof(Pose2)), 0);
    ASSERT_EQ(std::memcmp(&ra.covariance, &rb.covariance, sizeof(ra.covariance)), 0);
  }
  ASSERT_EQ(a.map().tiles().size(), b.map().tiles().size());
  for (size_t i = 0; i < a.map().tiles().size(); ++i) {
    EXPECT_EQ(std::memcmp(&a.map().tiles()[i].sheets, &b.map().tiles()[i].sheets, sizeof(SdfTile::sheets)), 0);
  }
}

TEST(Pipeline, SkipsScansWithoutReturns) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Pipeline pipeline({});
  PlanarScan scan;
  scan.utime = 1'000'000;
  EXPECT_EQ(pipeline.Process(scan).status, Status::kSkipped);
  for (const float range : {nan, inf, -inf, 0.0F, -1.0F, 1e30F}) {
    scan.utime += 100'000;
    scan.beams.assign(100, {range, 0.1F, 0});
    EXPECT_EQ(pipeline.Process(scan).status, Status::kSkipped) << range;
  }
  scan.beams.assign(100, {1.0F, nan, 0});
  EXPECT_EQ(pipeline.Process(scan).status, Status::kSkipped);
  scan.beams.assign(1, {1.0F, 0.0F, 0});
  EXPECT_EQ(pipeline.Process(scan).status, Status::kSkipped);
  EXPECT_TRUE(pipeline.map().empty());
}

TEST(Pipeline, BadBeamsAmongGoodOnesAndChangingNumbers) {
  auto frames = Drive(Episode(1008, RangeNoise::None(), false, 5.0));
  std::mt19937_64 random(9);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0F, -3.0F};
  for (PlanarFrame& frame : frames) {
    for (Beam& beam : frame.scan.beams) {
      if (random() % 4 == 0) beam.range_m = bad[random() % 4];
    }
    std::vector<Beam>& beams = frame.scan.beams;
    beams.resize(beams.size() - random() % 200);
  }
  EXPECT_LT(MeanError(frames), 0.003);
}

TEST(Pipeline, StampsThatStandStillOrJumpBack) {
  auto frames = Drive(Episode(1009, RangeNoise::None(), false, 4.0));
  Pipeline pipeline(StartingAt(frames.front().T_world_body));
  for (size_t i = 0; i < 20; ++i) (void)pipeline.Process(frames[i].scan);
  EXPECT_EQ(pipeline.Process(frames[19].scan).status, Status::kSkipped) << "the same scan again";
  EXPECT_EQ(pipeline.Process(frames[15].scan).status, Status::kSkipped) << "half a second late";
  frames[20].scan.utime -= 1'000'000'000;
  const Result back = pipeline.Process(frames[20].scan);
  EXPECT_NE(back.status, Status::kSkipped) << "the clock was set back";
  EXPECT_LT((back.T_map_body.translation() - frames[20].T_world_body.translation()).norm(), 0.01);
  for (const int64_t utime : {std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min(), int64_t{0}}) {
    frames[20].scan.utime = utime;
    EXPECT_TRUE(pipeline.Process(frames[20].scan).T_map_body.IsFinite()) << utime;
  }
}

TEST(Pipeline, AbsurdBeamTimesAreIgnored) {
  auto frames = Drive(Episode(1009, RangeNoise::None(), false, 2.0));
  for (PlanarFrame& frame : frames) {
    for (Beam& beam : frame.scan.beams) beam.dt_us = std::numeric_limits<int32_t>::min();
  }
  EXPECT_LT(MeanError(frames), 0.003);
}

TEST(Pipeline, FindsItselfAfterAJump) {
  const auto frames = Drive(Episode(1010, RangeNoise::Low(), false, 20.0));
  Pipeline pipeline(StartingAt(frames.front().T_world_body));
  for (size_t i = 0; i < 150; ++i) (void)pipeline.Process(frames[i].scan);
  Status status = Status::kTracking;
  Pose2 T_map_body;
  size_t jump = 150;  // the next scan that lies half a metre away
  while ((frames[jump].T_world_body.translation() - frames[149].T_world_body.translation()).norm() < 0.5) ++jump;
  for (size_t i = jump; i < jump + 3; ++i) {
    PlanarScan scan = frames[i].scan;
    scan.utime -= 100'000 * static_cast<int64_t>(jump - 150);
    const Result result = pipeline.Process(scan);
    if (i == jump) status = result.status;
    T_map_body = frames[i].T_world_body.inverse() * result.T_map_body;
  }
  EXPECT_EQ(status, Status::kRelocalized);
  EXPECT_LT(T_map_body.Log().norm(), 0.01);
}

TEST(Pipeline, SaysSoWhenLost) {
  const auto frames = Drive(Episode(1011, RangeNoise::None(), false, 3.0));
  Pipeline pipeline({});
  for (const PlanarFrame& frame : frames) (void)pipeline.Process(frame.scan);
  std::mt19937_64 random(1);
  PlanarScan rubbish = frames.back().scan;
  rubbish.utime += 100'000;
  for (Beam& beam : rubbish.beams) beam.range_m = 0.5F + 0.001F * static_cast<float>(random() % 4000);
  const uint64_t revision = pipeline.map().revision();
  EXPECT_EQ(pipeline.Process(rubbish).status, Status::kLost);
  EXPECT_EQ(pipeline.map().revision(), revision) << "nothing is mapped from a lost pose";
}

TEST(Pipeline, WritesTheMapAfterEnoughMotion) {
  const auto frames = Drive(Episode(1013, RangeNoise::Low(), false, 10.0));
  Options options = StartingAt(frames.front().T_world_body);
  options.fusion.update_distance_m = 0.3;
  options.fusion.update_angle_rad = 0.5;
  Pipeline pipeline(options);
  Pose2 T_map_body_written;
  for (const PlanarFrame& frame : frames) {
    const uint64_t revision = pipeline.map().revision();
    const Pose2 T_map_body = pipeline.Process(frame.scan).T_map_body;
    const Pose2 moved = T_map_body_written.inverse() * T_map_body;
    const bool due = revision == 0 || moved.translation().norm() >= 0.3 || std::abs(moved.yaw()) >= 0.5;
    ASSERT_EQ(pipeline.map().revision() != revision, due);
    if (due) T_map_body_written = T_map_body;
  }
}

TEST(Pipeline, LocalizesOnALoadedMapWithoutChangingIt) {
  const auto frames = Drive(Episode(1012, RangeNoise::Low(), false, 20.0));
  Pipeline mapper(StartingAt(frames.front().T_world_body));
  for (const PlanarFrame& frame : frames) (void)mapper.Process(frame.scan);

  Pipeline localizer({.localize_only = true});
  localizer.SetMap(mapper.map());
  const uint64_t revision = localizer.map().revision();
  localizer.SetPose(frames[100].T_world_body * Pose2(0.3, -0.2, 0.1));
  for (size_t i = 100; i < 130; ++i) {
    const Result result = localizer.Process(frames[i].scan);
    EXPECT_LT((frames[i].T_world_body.inverse() * result.T_map_body).Log().norm(), 0.01) << i;
  }
  EXPECT_EQ(localizer.map().revision(), revision);

  localizer.Reset();
  EXPECT_TRUE(localizer.map().empty());
  EXPECT_EQ(localizer.Process(frames[0].scan).status, Status::kLost) << "no map to localize on";
}

TEST(Pipeline, CorridorIsHeldByOdometry) {
  const auto episode = PlanarEpisode::Create(
      CorridorWorld(),
      {.seed = 1, .duration_s = 20.0, .lidar = {.noise = RangeNoise::Low()}, .odometry = {.rate_hz = 50.0}});
  ASSERT_TRUE(episode);
  const Pose2 T_world_odom = episode->Frame(0).T_world_body;
  Pipeline pipeline(StartingAt(T_world_odom));
  size_t next = 0;
  int degenerate = 0;
  double worst_m = 0.0, worst_odometry_m = 0.0;
  for (int i = 0; i < episode->num_frames(); ++i) {
    const PlanarFrame frame = episode->Frame(i);
    Pose2 T_odom_body;
    for (; next < episode->odometry().size() && episode->odometry()[next].utime <= frame.scan.utime; ++next) {
      T_odom_body = episode->odometry()[next].T_odom_body;
      pipeline.AddOdometry(episode->odometry()[next].utime, T_odom_body);
    }
    const Result result = pipeline.Process(frame.scan);
    if (result.status == Status::kDegenerate) ++degenerate;
    const auto error_m = [&](const Pose2& T) { return (T.translation() - frame.T_world_body.translation()).norm(); };
    worst_m = std::max(worst_m, error_m(result.T_map_body));
    worst_odometry_m = std::max(worst_odometry_m, error_m(T_world_odom * T_odom_body));
  }
  EXPECT_GT(degenerate, 20);
  EXPECT_LT(worst_m, 1.1 * worst_odometry_m);
}

TEST(Options, DefaultsAreValidAndComplaintsNameTheField) {
  EXPECT_EQ(Options{}.Validate(), "");
  EXPECT_EQ(Options{.cell_m = 0.0}.Validate(), "cell_m: must be > 0");
  EXPECT_EQ((Options{.cell_m = std::numeric_limits<double>::quiet_NaN()}.Validate()), "cell_m: must be > 0");
  Options options;
  options.fusion.carve_every = 0;
  EXPECT_EQ(options.Validate(), "fusion.carve_every: must be >= 1");
  options = {};
  options.recovery.min_overlap = 1.5;
  EXPECT_EQ(options.Validate(), "recovery.min_overlap: must lie in [0, 1]");
}

}  // namespace
}  // namespace lcmslam::sdf2d
