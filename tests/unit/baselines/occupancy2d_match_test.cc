#include "baselines/occupancy2d_match.h"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace lcmslam::occupancy2d {
namespace {

using Eigen::Vector2d;
using Gradient = LogOddsGrid::Gradient;

// The end points of `count` beams all round, seen from the middle of a 4 x 3 m room that stands askew to the cells.
std::vector<Vector2d> RoomScan(int count) {
  const Pose2 T_body_room(0.0, 0.0, 0.3);
  std::vector<Vector2d> ends;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * M_PI * i / count;
    const Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
    const double range_m = std::min(2.0 / std::abs(direction.x()), 1.5 / std::abs(direction.y()));
    ends.push_back(T_body_room * (range_m * direction));
  }
  return ends;
}

std::vector<LogOddsGrid> Levels(const std::vector<Vector2d>& p_map, int scans = 3) {
  std::vector<LogOddsGrid> levels;
  for (const double cell_m : {0.025, 0.05, 0.1}) levels.emplace_back(LogOddsGrid::Options{.cell_m = cell_m});
  for (LogOddsGrid& level : levels) {
    for (int i = 0; i < scans; ++i) level.Insert({0.0, 0.0}, p_map);
  }
  return levels;
}

TEST(Linearize, IsTheSumOverPointsOfNumericDerivatives) {
  const LogOddsGrid grid = Levels(RoomScan(700)).front();
  const Pose2 T_map_body(0.0123, -0.0071, 0.011);
  const std::vector<Vector2d> p_body = RoomScan(97);
  const auto residual = [&](const Vector2d& p, const Eigen::Vector3d& by) {
    const Pose2 moved(T_map_body.x() + by.x(), T_map_body.y() + by.y(), T_map_body.yaw() + by.z());
    return 1.0 - grid.At(moved * p, Gradient::kExact).probability;
  };
  constexpr double kStep = 1e-7;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double r2 = 0.0;
  for (const Vector2d& p : p_body) {
    Eigen::Vector3d J;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      J(i) = -(residual(p, step) - residual(p, -step)) / (2.0 * kStep);
    }
    const double r = residual(p, Eigen::Vector3d::Zero());
    H += J * J.transpose(), b += J * r, r2 += r * r;
  }
  const NormalEquations sums = Linearize(grid, p_body, T_map_body, Gradient::kExact);
  ASSERT_GT(H.norm(), 1.0);
  EXPECT_TRUE(sums.H.isApprox(H, 1e-6)) << sums.H << "\n\n" << H;
  EXPECT_TRUE(sums.b.isApprox(b, 1e-6)) << sums.b.transpose() << "\n" << b.transpose();
  EXPECT_NEAR(sums.r2, r2, 1e-9);
}

TEST(Match, RecoversKnownOffsets) {
  const std::vector<Vector2d> p_body = RoomScan(667);
  for (const Gradient gradient : {Gradient::kExact, Gradient::kReleased}) {
    for (unsigned seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(seed);
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> metres(-0.05, 0.05), radians(-0.05, 0.05);
      const Pose2 T_map_body(metres(random), metres(random), radians(random));
      std::vector<Vector2d> p_map;
      for (const Vector2d& p : p_body) p_map.push_back(T_map_body * p);
      const MatchResult match = Match(Levels(p_map), p_body, Pose2(), {.gradient = gradient});
      ASSERT_TRUE(match.solved);
      EXPECT_EQ(match.iterations, 4 + 4 + 6);
      const Pose2 error = T_map_body.inverse() * match.T_map_body;
      EXPECT_LT(error.translation().norm(), 0.005);
      EXPECT_LT(std::abs(error.yaw()), 0.003);
      EXPECT_GT(match.inlier_ratio, 0.9);
      EXPECT_LT(match.residual_rms_m, 0.025);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(match.covariance);
      EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0);
      EXPECT_LT(eigen.eigenvalues().maxCoeff(), 1e-4);
    }
  }
}

TEST(Match, OneLevelOnly) {
  const std::vector<Vector2d> p_body = RoomScan(667);
  const std::vector<LogOddsGrid> levels = Levels(p_body);
  const MatchResult match = Match(std::span(levels).first(1), p_body, {0.01, -0.01, 0.01}, {});
  ASSERT_TRUE(match.solved);
  EXPECT_EQ(match.iterations, 6);
  EXPECT_LT(match.T_map_body.translation().norm(), 0.005);
}

TEST(Match, RotatesNoFurtherThanItsSteps) {
  const std::vector<Vector2d> p_body = RoomScan(667);
  const MatchResult match = Match(Levels(p_body), p_body, {0.0, 0.0, 0.1}, {.max_rotation_step_rad = 1e-4});
  ASSERT_TRUE(match.solved);
  EXPECT_NEAR(match.T_map_body.yaw(), 0.1 - 14 * 1e-4, 1e-9);
}

TEST(Match, KeepsTheGuessWhereTheMapDoesNotFixThePose) {
  const Pose2 guess(0.01, 0.02, 0.03);
  const std::vector<Vector2d> scan = RoomScan(667);
  const std::vector<LogOddsGrid> empty = Levels({}), room = Levels(scan);
  LogOddsGrid wall({});  // along x, each beam square to it: nothing says where on it
  for (int i = -80; i <= 80; ++i) wall.Insert({0.025 * i, 0.0}, std::vector<Vector2d>{{0.025 * i, 1.0}});
  std::vector<Vector2d> middle;
  for (int i = -50; i <= 50; ++i) middle.emplace_back(0.01 * i, 1.0);
  const struct {
    const char* what;
    MatchResult match;
  } cases[] = {
      {"empty map", Match(empty, scan, guess, {})},
      {"no points", Match(room, {}, guess, {})},
      {"far from the map", Match(room, scan, {500.0, 0.0, 0.0}, {})},
      {"one wall", Match(std::span(&wall, 1), middle, guess, {})},
  };
  for (const auto& [what, match] : cases) {
    EXPECT_FALSE(match.solved) << what;
    EXPECT_TRUE(match.covariance.isZero()) << what;
  }
  EXPECT_EQ(cases[0].match.T_map_body.x(), guess.x());
  EXPECT_EQ(cases[2].match.T_map_body.x(), 500.0);
}

TEST(Match, ValidateNamesTheField) {
  EXPECT_EQ(MatchOptions{}.Validate(), "");
  EXPECT_EQ(MatchOptions{.coarse_steps = 0}.Validate(), "coarse_steps: must be in 1..100");
  EXPECT_EQ(MatchOptions{.fine_steps = 101}.Validate(), "fine_steps: must be in 1..100");
  EXPECT_EQ(MatchOptions{.max_rotation_step_rad = NAN}.Validate(), "max_rotation_step_rad: must be positive");
}

}  // namespace
}  // namespace lcmslam::occupancy2d
