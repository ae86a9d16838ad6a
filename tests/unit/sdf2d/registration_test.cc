#include "sdf2d/registration.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

#include "sdf2d/fusion.h"
#include "sdf2d/recovery.h"
#include "sdf2d/sudden_motion.h"
#include "simulation/planar_world.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Walls seen from inside, as lines of a scan: exact, and known everywhere.
SdfMap MapOf(const std::vector<Segment>& walls, double cell_m, double band_m) {
  std::vector<SurfaceLine> lines;
  for (const Segment& wall : walls) {
    const Vector2d along = (wall.b - wall.a).normalized();
    lines.push_back({.normal = Vector2d(-along.y(), along.x()), .begin = wall.a, .end = wall.b});
  }
  SdfMap map(cell_m);
  ScanField field;
  const FusionOptions options{.band_cells = band_m / cell_m};
  field.Rasterize(lines, Pose2(), cell_m, options);
  Fuse(field, options, &map);
  return map;
}

std::vector<Segment> RoomWalls() {  // counter-clockwise, normals inwards
  return {{{0.0, 0.0}, {6.0, 0.0}}, {{6.0, 0.0}, {6.0, 4.0}}, {{6.0, 4.0}, {0.0, 4.0}}, {{0.0, 4.0}, {0.0, 0.0}}};
}

std::vector<Segment> CorridorWalls() { return {{{-50.0, 0.0}, {50.0, 0.0}}, {{50.0, 2.0}, {-50.0, 2.0}}}; }

// A scan whose body moves with `twist` and is at T_world_body at the last beam.
std::vector<ScanPoint> Scan(const PlanarWorld& world, const Pose2& T_world_body, const Vector3d& twist, double sigma_m,
                            double sweep_s, std::mt19937_64& random) {
  boost::random::normal_distribution<double> noise;
  std::vector<ScanPoint> points;
  constexpr int kBeams = 400;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = -2.1 + 4.2 * i / kBeams;
    const double dt_s = sweep_s * (static_cast<double>(i + 1) / kBeams - 1.0);
    const Pose2 T = T_world_body * Pose2::Exp(twist * dt_s);
    const Vector2d u(std::cos(angle), std::sin(angle));
    const auto hit = world.CastRay(T.translation(), T.rotation() * u, 20.0);
    if (!hit) continue;
    const double range = hit->range_m + sigma_m * noise(random);
    points.push_back({range * u, range, dt_s});
  }
  return points;
}

MotionState Prediction(const Pose2& T_map_body, const Vector3d& twist, double sigma) {
  MotionState state;
  state.T_map_body = T_map_body;
  state.twist_body = twist;
  state.covariance = sigma * sigma * Matrix6d::Identity();
  return state;
}

NoiseModel Noise(double sigma_m) { return NoiseModel({.estimate = false, .constant_m = sigma_m}); }

TEST(Align, RecoversKnownOffset) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> metres(-0.1, 0.1), place(1.2, 2.8), turn(-3.1, 3.1);
    const Pose2 truth(place(random), place(random), turn(random));
    const auto points = Scan(world, truth, Vector3d::Zero(), 0.0, 0.0, random);
    const Pose2 guess = truth * Pose2(metres(random), metres(random), 0.5 * metres(random));
    const AlignResult result =
        Align(map, points, Vector2d::Zero(), Noise(0.001), Prediction(guess, Vector3d::Zero(), 0.3), {});
    EXPECT_NE(result.status, AlignStatus::kTooFewPoints);
    EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 2e-4);
    EXPECT_GT(result.InlierRatio(), 0.95);
    EXPECT_TRUE(result.unobservable.isZero());
  }
}

TEST(Align, DeskewsWithThePredictedVelocity) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  std::mt19937_64 random(1);
  const Pose2 truth(2.5, 1.8, 0.4);
  const Vector3d twist(0.9, -0.2, 1.2);
  const auto points = Scan(world, truth, twist, 0.0, 0.1, random);
  const AlignResult result =
      Align(map, points, Vector2d::Zero(), Noise(0.001), Prediction(truth * Pose2(0.03, 0.02, 0.02), twist, 1.0), {});
  EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 1e-3);
  const AlignResult rigid =
      Align(map, points, Vector2d::Zero(), Noise(0.001), Prediction(truth, Vector3d::Zero(), 1.0), {});
  EXPECT_GT((truth.inverse() * rigid.state.T_map_body).Log().norm(), 0.02) << "the scan is distorted";
}

// Errors over many noisy scans against the covariance reported with them.
TEST(Align, CovarianceIsConsistent) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  constexpr int kTrials = 200;
  double sum = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::mt19937_64 random(1000 + trial);
    std::uniform_real_distribution<double> place(1.5, 2.5), turn(-3.1, 3.1);
    const Pose2 truth(place(random) + 0.8, place(random), turn(random));
    const auto points = Scan(world, truth, Vector3d::Zero(), 0.02, 0.0, random);
    const AlignResult result =
        Align(map, points, Vector2d::Zero(), Noise(0.02), Prediction(truth, Vector3d::Zero(), 0.5),
              {.map_sigma_m = 1e-4, .shared_sigma_m = 0.0, .independence = 1.0});
    const Vector3d error = (truth.inverse() * result.state.T_map_body).Log();
    const Eigen::Matrix3d covariance = result.state.covariance.topLeftCorner<3, 3>();
    sum += error.dot(covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / kTrials, 3.0, 1.0) << "mean normalized squared error of three dimensions";
}

TEST(Align, CorridorHoldsItsDirectionByPrediction) {
  const PlanarWorld world(CorridorWalls());
  const SdfMap map = MapOf(CorridorWalls(), 0.05, 0.3);
  std::mt19937_64 random(2);
  const Pose2 truth(3.0, 0.9, 0.3);
  const auto points = Scan(world, truth, Vector3d::Zero(), 0.01, 0.0, random);
  const Pose2 guess(3.08, 0.95, 0.33);
  const AlignResult result =
      Align(map, points, Vector2d::Zero(), Noise(0.01), Prediction(guess, Vector3d::Zero(), 0.1), {});
  EXPECT_EQ(result.UnobservableAxes(), (std::array<bool, 3>{true, false, false}));
  EXPECT_NEAR(result.state.T_map_body.x(), guess.x(), 0.01);
  EXPECT_NEAR(result.state.T_map_body.y(), truth.y(), 0.005);
  EXPECT_NEAR(result.state.T_map_body.yaw(), truth.yaw(), 0.002);
  const Eigen::Matrix3d covariance = result.state.PoseCovarianceInMap();
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 0.1, 0.02) << "as uncertain as the prediction";
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.01);
}

TEST(Align, OutliersAreOutvoted) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  std::mt19937_64 random(3);
  const Pose2 truth(2.5, 1.8, 0.4);
  auto points = Scan(world, truth, Vector3d::Zero(), 0.005, 0.0, random);
  for (size_t i = 0; i < points.size() / 4; ++i) points[i].p_body *= 0.95;  // a row of people before the wall
  const AlignResult result = Align(map, points, Vector2d::Zero(), Noise(0.005),
                                   Prediction(truth * Pose2(0.02, 0.02, 0.01), Vector3d::Zero(), 0.3), {});
  EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 0.02);
}

TEST(Align, TooLittleLeavesThePrediction) {
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  const MotionState prediction = Prediction(Pose2(2.0, 2.0, 0.1), Vector3d(0.1, 0.0, 0.0), 0.1);
  std::mt19937_64 random(4);
  const auto points = Scan(PlanarWorld(RoomWalls()), Pose2(2.0, 2.0, 0.1), Vector3d::Zero(), 0.0, 0.0, random);
  const std::vector<ScanPoint> few(points.begin(), points.begin() + 5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ScanPoint> bad(100, {Vector2d(nan, nan), 1.0, 0.0});
  for (const auto& scan : {std::vector<ScanPoint>{}, few, bad}) {
    const AlignResult result = Align(map, scan, Vector2d::Zero(), Noise(0.01), prediction, {});
    EXPECT_EQ(result.status, AlignStatus::kTooFewPoints);
    EXPECT_EQ(result.state.T_map_body.Log(), prediction.T_map_body.Log());
  }
  const AlignResult result = Align(SdfMap(0.05), points, Vector2d::Zero(), Noise(0.01), prediction, {});
  EXPECT_EQ(result.status, AlignStatus::kTooFewPoints);
}

TEST(Recovery, CoarseLevelWidensTheBasin) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.08), coarse_map = Coarsen(map, 0.2, {});
  std::mt19937_64 random(5);
  const Pose2 truth(2.5, 1.8, 0.4);
  const auto points = Scan(world, truth, Vector3d::Zero(), 0.005, 0.0, random);
  const MotionState prediction = Prediction(truth * Pose2(0.2, -0.15, 0.05), Vector3d::Zero(), 0.05);
  const AlignResult result = AlignCoarseToFine(map, coarse_map, points, Vector2d::Zero(), Noise(0.005), prediction, {});
  EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 0.005);
}

TEST(Recovery, SearchFindsAFarPose) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.08), coarse_map = Coarsen(map, 0.2, {});
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> metres(-0.8, 0.8);
    const Pose2 truth(2.5, 1.8, 0.4);
    const auto points = Scan(world, truth, Vector3d::Zero(), 0.005, 0.0, random);
    const Pose2 guess = truth * Pose2(metres(random), metres(random), 0.5 * metres(random));
    const AlignResult result = SearchAround(map, coarse_map, points, Vector2d::Zero(), Noise(0.005),
                                            Prediction(guess, Vector3d::Zero(), 0.05), 1.0, 0.6, {});
    EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 0.005);
  }
}

constexpr double kSweep_s = 0.15;  // of the scans below, and between them

TEST(SuddenMotion, SkewIsTheUnforeseenTurn) {
  const std::vector<ScanPoint> points = {{{1.0, 0.0}, 1.0, -kSweep_s}, {{2.0, 0.0}, 2.0, 0.0}};
  const MotionState prediction = Prediction(Pose2(1.0, 2.0, 3.0), {0.2, 0.0, 0.5}, 0.1);
  const Pose2 turned = prediction.T_map_body * Pose2::Exp(kSweep_s * Vector3d(0.0, 0.0, -2.0));
  EXPECT_NEAR(Skew_rad(points, prediction, kSweep_s, turned), 2.0 * kSweep_s, 1e-9);
  EXPECT_NEAR(Skew_rad(points, prediction, kSweep_s, prediction.T_map_body), 0.0, 1e-9);
  EXPECT_EQ(Skew_rad(points, prediction, 0.0, turned), 0.0) << "no scan before";
  EXPECT_EQ(Skew_rad({}, prediction, kSweep_s, turned), 0.0);
}

TEST(SuddenMotion, DeskewingAgainComesCloser) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.3);
  const Pose2 last(2.5, 1.8, 0.4);
  std::mt19937_64 random(6);
  for (const double turn_rate : {-0.6, -0.2, 0.2, 0.6}) {
    SCOPED_TRACE(turn_rate);
    const Vector3d twist(0.1, 0.0, turn_rate);
    const Pose2 truth = last * Pose2::Exp(kSweep_s * twist);
    const auto points = Scan(world, truth, twist, 0.005, kSweep_s, random);
    const MotionState at_rest = Prediction(last, Vector3d::Zero(), 0.2);
    const auto error = [&](const AlignResult& align) {
      return (truth.inverse() * align.state.T_map_body).Log().norm();
    };
    const AlignResult once = Align(map, points, Vector2d::Zero(), Noise(0.005), at_rest, {});
    const AlignResult again =
        AlignDeskewedAgain(map, points, Vector2d::Zero(), Noise(0.005), at_rest, kSweep_s, once, {});
    EXPECT_GE(again.inliers, once.inliers);
    EXPECT_LT(error(again), 0.5 * error(once));
  }
}

// Between two scans, from rest or from 3 rad/s.
TEST(SuddenMotion, TurnsAreTried) {
  const PlanarWorld world(RoomWalls());
  const SdfMap map = MapOf(RoomWalls(), 0.05, 0.08), coarse_map = Coarsen(map, 0.2, {});
  const Pose2 last(2.5, 1.8, 0.4);
  std::mt19937_64 random(6);
  for (const double before : {0.0, 3.0}) {
    for (const double turn_rate : {-3.0, -1.2, 0.0, 3.0, 4.9}) {
      SCOPED_TRACE(testing::Message() << before << " then " << turn_rate << " rad/s");
      const Vector3d twist(0.1, 0.0, turn_rate), foreseen(0.1, 0.0, before);
      const Pose2 truth = last * Pose2::Exp(kSweep_s * twist);
      const auto points = Scan(world, truth, twist, 0.005, kSweep_s, random);
      const MotionState prediction = Prediction(last * Pose2::Exp(kSweep_s * foreseen), foreseen, 0.05);
      const AlignResult result =
          AlignTurning(map, coarse_map, points, Vector2d::Zero(), Noise(0.005), prediction, kSweep_s, 5.0, {});
      EXPECT_LT((truth.inverse() * result.state.T_map_body).Log().norm(), 0.01);
      EXPECT_LT((result.state.twist_body - twist).norm(), 0.1);
      EXPECT_GT(result.InlierRatio(), 0.95);
    }
  }
  const AlignResult none = AlignTurning(map, coarse_map, {}, Vector2d::Zero(), Noise(0.005),
                                        Prediction(last, {0, 0, 0}, 0.05), kSweep_s, 5.0, {});
  EXPECT_EQ(none.status, AlignStatus::kTooFewPoints);
  EXPECT_EQ(none.state.T_map_body.Log(), last.Log()) << "the prediction stands";
}

}  // namespace
}  // namespace lcmslam::sdf2d
