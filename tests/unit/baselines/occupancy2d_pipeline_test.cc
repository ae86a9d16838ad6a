#include "baselines/occupancy2d_pipeline.h"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

namespace lcmslam::occupancy2d {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// A drive through the 5 x 5 m room: `low` noise, no distortion.
std::vector<PlanarFrame> Drive(uint64_t seed, double duration_s, const Pose2& T_body_lidar = {}) {
  const auto episode = PlanarEpisode::Create(
      Room5World(), {.seed = seed,
                     .duration_s = duration_s,
                     .lidar = {.noise = RangeNoise::Low(), .T_body_lidar = T_body_lidar, .motion_distortion = false},
                     .drive = {.drive = PlanarDrive::kOmnidirectional}});
  std::vector<PlanarFrame> frames;
  for (int i = 0; i < episode->num_frames(); ++i) frames.push_back(episode->Frame(i));
  return frames;
}

std::vector<Result> RunThrough(const std::vector<PlanarFrame>& frames, const Options& options) {
  Pipeline pipeline(options);
  std::vector<Result> results;
  for (const PlanarFrame& frame : frames) results.push_back(pipeline.Process(frame.scan));
  return results;
}

// Of the positions, after least-squares alignment in SE(2): in the complex plane, a turn by arg sum conj(a) b.
double MeanError(const std::vector<PlanarFrame>& frames, const std::vector<Result>& results) {
  const Eigen::Index n = static_cast<Eigen::Index>(results.size());
  Eigen::ArrayXcd estimate(n), truth(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Pose2& T_world_body = frames[i].T_world_body;
    estimate(i) = {results[i].T_map_body.x(), results[i].T_map_body.y()};
    truth(i) = {T_world_body.x(), T_world_body.y()};
  }
  estimate -= estimate.mean();
  truth -= truth.mean();
  const std::complex<double> turn = std::polar(1.0, std::arg((estimate.conjugate() * truth).sum()));
  return (turn * estimate - truth).abs().mean();
}

double MeanErrorOverEpisodes(const Options& options) {
  constexpr int kEpisodes = 6;
  double sum_m = 0.0;
  for (uint64_t seed = 101; seed < 101 + kEpisodes; ++seed) {
    const std::vector<PlanarFrame> frames = Drive(seed, 60.0);
    sum_m += MeanError(frames, RunThrough(frames, options));
  }
  return sum_m / kEpisodes;
}

// What Hector SLAM reaches in this room, and a quarter more.
TEST(Pipeline, IsAFairPeerOfTheOriginal) { EXPECT_LT(MeanErrorOverEpisodes({}), 1.25 * 0.0058); }

TEST(Pipeline, IsAFairPeerOfTheOriginalOnCoarseCells) {
  EXPECT_LT(MeanErrorOverEpisodes({.grid = {.cell_m = 0.05}, .update_angle_rad = 0.06}), 1.25 * 0.0098);
}

TEST(Pipeline, TheReleasedGradientWorksToo) {
  const std::vector<PlanarFrame> frames = Drive(3, 20.0);
  const std::vector<Result> released = RunThrough(frames, {.match = {.gradient = LogOddsGrid::Gradient::kReleased}});
  EXPECT_LT(MeanError(frames, released), 0.01);
  EXPECT_NE(released.back().T_map_body.x(), RunThrough(frames, {}).back().T_map_body.x());
}

TEST(Pipeline, TheMapStartsAtTheFirstBodyPose) {
  const std::vector<PlanarFrame> frames = Drive(1, 5.0);
  for (const Pose2& start : {Pose2(), Pose2(3.0, -2.0, 2.5)}) {
    const std::vector<Result> results = RunThrough(frames, {.T_map_body_initial = start});
    EXPECT_EQ(results[0].status, Status::kInitializing);
    EXPECT_TRUE(results[0].map_written);
    EXPECT_EQ(results[0].T_map_body.translation(), start.translation());
    for (size_t i = 1; i < results.size(); ++i) {
      EXPECT_EQ(results[i].status, Status::kTracking);
      const Pose2 truth = start * frames[0].T_world_body.inverse() * frames[i].T_world_body;
      const Pose2 error = truth.inverse() * results[i].T_map_body;
      EXPECT_LT(error.translation().norm(), 0.03);
      EXPECT_LT(std::abs(error.yaw()), 0.02);
    }
  }
}

TEST(Pipeline, TheLidarMayBeMountedAnywhere) {
  const Pose2 T_body_lidar(0.15, -0.1, 2.0);
  const std::vector<PlanarFrame> frames = Drive(2, 20.0, T_body_lidar);
  EXPECT_LT(MeanError(frames, RunThrough(frames, {.T_body_lidar = T_body_lidar})), 0.01);
}

TEST(Pipeline, SameScansSameBits) {
  const std::vector<PlanarFrame> frames = Drive(4, 10.0);
  const std::vector<Result> a = RunThrough(frames, {}), b = RunThrough(frames, {});
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].T_map_body.translation(), b[i].T_map_body.translation());
    EXPECT_EQ(a[i].T_map_body.yaw(), b[i].T_map_body.yaw());
    EXPECT_EQ(a[i].covariance, b[i].covariance);
  }
}

TEST(Pipeline, WritesTheMapAfterMotionOnly) {
  const std::vector<PlanarFrame> frames = Drive(5, 20.0);
  const PlanarScan still = frames[0].scan;
  Pipeline pipeline({});
  EXPECT_TRUE(pipeline.Process(still).map_written);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(pipeline.Process(still).map_written);

  Pose2 T_map_body_written;
  for (const Result& result : RunThrough(frames, {})) {
    const Pose2 motion = T_map_body_written.inverse() * result.T_map_body;
    const bool moved = motion.translation().norm() > 0.4 || std::abs(motion.yaw()) > 0.9;
    EXPECT_EQ(result.map_written, moved || result.status == Status::kInitializing);
    if (result.map_written) T_map_body_written = result.T_map_body;
  }
}

TEST(Pipeline, SurvivesWhateverAScanHolds) {
  const std::vector<PlanarFrame> frames = Drive(6, 5.0);
  const PlanarScan good = frames[0].scan;
  Pipeline pipeline({});
  EXPECT_EQ(pipeline.Process({}).status, Status::kSkipped) << "empty, and nothing before it";
  EXPECT_EQ(pipeline.Process(good).status, Status::kInitializing);
  std::vector<PlanarScan> awkward(6);
  awkward[1].beams = {{.range_m = 1.0F}};
  for (const float range_m : {kNan, kInf, -kInf, 0.0F, -1.0F, 1e30F, 1e-30F}) awkward[2].beams.push_back({range_m});
  awkward[3].beams.assign(100, {.range_m = 1.0F, .angle_rad = kNan});
  awkward[4].beams.assign(2, good.beams[0]);
  awkward[5] = {.utime = std::numeric_limits<int64_t>::min(), .beams = {}};
  for (const PlanarScan& scan : awkward) {
    const Result result = pipeline.Process(scan);
    EXPECT_EQ(result.status, Status::kSkipped);
    EXPECT_EQ(result.utime, scan.utime);
    EXPECT_EQ(result.T_map_body.translation(), Eigen::Vector2d::Zero());
    EXPECT_FALSE(result.map_written);
  }
  PlanarScan half = good;  // other beams than before, holes among them
  half.beams.resize(half.beams.size() / 2);
  for (size_t i = 0; i < half.beams.size(); i += 3) half.beams[i].range_m = kNan;
  const Result result = pipeline.Process(half);
  EXPECT_EQ(result.status, Status::kTracking);
  EXPECT_EQ(result.num_points, 222);
  EXPECT_LT(result.T_map_body.translation().norm(), 0.02);
}

TEST(Pipeline, SaysWhenItIsLost) {
  const std::vector<PlanarFrame> frames = Drive(7, 1.0);
  Pipeline pipeline({});
  ASSERT_EQ(pipeline.Process(frames[0].scan).status, Status::kInitializing);
  pipeline.SetPose({90.0, 0.0, 1.0});
  const Result result = pipeline.Process(frames[1].scan);
  EXPECT_EQ(result.status, Status::kLost);
  EXPECT_EQ(result.T_map_body.x(), 90.0);
  EXPECT_FALSE(result.map_written);
  pipeline.SetPose({});
  EXPECT_EQ(pipeline.Process(frames[2].scan).status, Status::kTracking);
}

TEST(Pipeline, ResetForgets) {
  const std::vector<PlanarFrame> frames = Drive(8, 5.0);
  Pipeline pipeline({});
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(pipeline.Process(frames[20].scan).status, Status::kInitializing);
    EXPECT_EQ(pipeline.Process(frames[21].scan).status, Status::kTracking);
    pipeline.Reset();
    EXPECT_TRUE(pipeline.map().ToOccupancyGrid().cells.empty());
  }
}

TEST(Pipeline, LocalizesWithoutWriting) {
  const std::vector<PlanarFrame> frames = Drive(9, 20.0);
  Pipeline pipeline({});
  EXPECT_TRUE(pipeline.Process(frames[0].scan).map_written);
  const std::vector<int8_t> before = pipeline.map().ToOccupancyGrid().cells;
  pipeline.SetLocalizeOnly(true);
  for (size_t i = 1; i < frames.size(); ++i) EXPECT_FALSE(pipeline.Process(frames[i].scan).map_written);
  EXPECT_EQ(pipeline.map().ToOccupancyGrid().cells, before);

  Pipeline mapless({.localize_only = true});
  EXPECT_EQ(mapless.Process(frames[0].scan).status, Status::kLost);
}

TEST(Pipeline, OdometryCarriesItOverAGap) {
  const std::vector<PlanarFrame> frames = Drive(10, 20.0);
  const size_t last = frames.size() - 1;
  Pipeline pipeline({});
  const auto odometry = [&](size_t i) -> const PlanarFrame& {
    const PlanarFrame& frame = frames[i];
    pipeline.AddOdometry(frame.scan.utime, frame.T_world_body);
    return frame;
  };
  for (size_t i = 0; i < 20; ++i) (void)pipeline.Process(odometry(i).scan);
  for (size_t i = 20; i < last; ++i) (void)odometry(i);  // no scans
  const PlanarFrame& frame = odometry(last);
  const Pose2 truth = frames[0].T_world_body.inverse() * frame.T_world_body;
  ASSERT_GT(truth.translation().norm(), 0.5);
  const Result result = pipeline.Process(frame.scan);
  EXPECT_EQ(result.status, Status::kTracking);
  EXPECT_LT((result.T_map_body.translation() - truth.translation()).norm(), 0.05);
}

TEST(Pipeline, TheStopwatchTimesStagesAndNothingElse) {
  const std::vector<PlanarFrame> frames = Drive(11, 2.0);
  Pipeline timed({}), untimed({});
  double now_ms = 0.0;
  timed.SetStopwatch([&] { return now_ms += 1.0; });
  for (size_t i = 0; i < frames.size(); ++i) {
    const Result a = timed.Process(frames[i].scan), b = untimed.Process(frames[i].scan);
    EXPECT_EQ(a.T_map_body.translation(), b.T_map_body.translation());
    for (const double ms : a.stage_ms) EXPECT_EQ(ms, 1.0);
    for (const double ms : b.stage_ms) EXPECT_EQ(ms, 0.0);
  }
}

TEST(Pipeline, ValidateNamesTheField) {
  EXPECT_EQ(Options{}.Validate(), "");
  EXPECT_EQ(Options{.grid = {.cell_m = -1.0}}.Validate(), "grid.cell_m: must be positive");
  EXPECT_EQ(Options{.levels = 0}.Validate(), "levels: must be in 1..8");
  EXPECT_EQ(Options{.match = {.fine_steps = 0}}.Validate(), "match.fine_steps: must be in 1..100");
  EXPECT_EQ(Options{.update_distance_m = NAN}.Validate(), "update_distance_m: must not be negative");
  EXPECT_EQ(Options{.max_range_m = 0.01}.Validate(), "max_range_m: must exceed min_range_m");
  EXPECT_EQ((Options{.T_body_lidar = {NAN, 0.0, 0.0}}.Validate()), "T_body_lidar: must be finite");
}

}  // namespace
}  // namespace lcmslam::occupancy2d
