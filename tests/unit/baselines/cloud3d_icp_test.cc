#include "baselines/cloud3d_icp.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "unit/baselines/cloud3d_room.h"

namespace lcmslam::cloud3d {
namespace {

Map RoomMap() {
  Map map(MapOptions{.spacing_m = 0.1});
  map.Grow(RoomCloud(3000, 1));
  return map;
}

Pose3 PoseOf(const Vector6& v) {
  const Eigen::Vector3d turn = v.tail<3>();
  return {v.head<3>(), Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()))};
}

TEST(Icp, RecoversKnownMotion) {
  const Map map = RoomMap();
  const Cloud room = RoomCloud(500, 2);
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Vector6 v;
    for (int k = 0; k < 6; ++k) v(k) = 0.15 * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
    const Pose3 T_map_body = PoseOf(v);
    const IcpResult result = Icp(map, Transformed(T_map_body.inverse(), room), Pose3{}, IcpOptions{});
    ASSERT_TRUE(result.solved);
    EXPECT_LT((result.T_map_body.translation - T_map_body.translation).norm(), 1e-3);
    EXPECT_LT(AngleBetween(result.T_map_body.rotation, T_map_body.rotation), 1e-3);
    EXPECT_NEAR(result.inlier_ratio, 0.83, 0.03);
  }
}

// Against central differences of the sum of squares, along each of the six directions.
TEST(Linearize, AgreesWithNumericDerivatives) {
  const Map map = RoomMap();
  const Cloud reading = RoomCloud(50, 3);
  const Pose3 T_map_body = PoseOf((Vector6() << 0.1, -0.2, 0.05, 0.03, -0.02, 0.05).finished());
  const Cloud reading_map = Transformed(T_map_body, reading);
  const std::vector<Match> matches = FindMatches(map, reading_map, IcpOptions{});
  const NormalEquations sums = Linearize(map, reading_map, matches, T_map_body.translation);
  const auto sum_of_squares = [&](const Vector6& v) {
    const Pose3 step = PoseOf(v);
    double r2 = 0.0;
    for (const Match& match : matches) {
      const Eigen::Vector3d lever = reading_map.points[match.reading].cast<double>() - T_map_body.translation;
      const Eigen::Vector3d p = step.rotation * lever + T_map_body.translation + step.translation;
      const double r = map.normals()[match.map].cast<double>().dot(p - map.points()[match.map].cast<double>());
      r2 += r * r;
    }
    return r2;
  };
  EXPECT_NEAR(sums.r2, sum_of_squares(Vector6::Zero()), 1e-6 * sums.r2);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i) {
    const Vector6 step = kStep * Vector6::Unit(i);
    const double slope = (sum_of_squares(step) - sum_of_squares(-step)) / (2.0 * kStep);
    EXPECT_NEAR(-2.0 * sums.b(i), slope, 1e-4 * sums.b.norm()) << i;
  }
  EXPECT_TRUE(sums.H.isApprox(sums.H.transpose()));
  Matrix6 dense = Matrix6::Zero();
  for (const Match& match : matches) {
    const Eigen::Vector3d n = map.normals()[match.map].cast<double>();
    Vector6 J;
    J << n, (reading_map.points[match.reading].cast<double>() - T_map_body.translation).cross(n);
    dense += J * J.transpose();
  }
  EXPECT_TRUE(sums.H.isApprox(dense, 1e-9));
}

TEST(KeepInliers, KeepsTheNearestShare) {
  const Map map = RoomMap();
  const Cloud reading = RoomCloud(300, 4);
  const std::vector<Match> matches = FindMatches(map, reading, {.neighbours = 1});
  ASSERT_EQ(matches.size(), reading.size());
  std::vector<float> sorted_m2;
  for (const Match& match : matches) sorted_m2.push_back(match.distance_m2);
  std::ranges::sort(sorted_m2);
  for (const double ratio : {0.1, 0.5, 0.85, 1.0}) {
    const std::vector<Match> kept =
        KeepInliers(map, reading, matches, {.trim_ratio = ratio, .max_normal_angle_rad = 0.0});
    EXPECT_NEAR(static_cast<double>(kept.size()), ratio * static_cast<double>(matches.size()), 1.5);
    for (const Match& match : kept) EXPECT_LE(match.distance_m2, sorted_m2[kept.size() - 1]);
  }
  EXPECT_TRUE(KeepInliers(map, reading, {}, {}).empty());
}

TEST(KeepInliers, ComparesNormals) {
  const Map map = RoomMap();
  Cloud reading = RoomCloud(300, 4);
  for (size_t i = 0; i < reading.size(); i += 2) reading.normals[i] = -reading.normals[i];
  const std::vector<Match> kept = KeepInliers(map, reading, FindMatches(map, reading, {.neighbours = 1}),
                                              {.trim_ratio = 1.0, .max_normal_angle_rad = 0.75});
  EXPECT_GT(kept.size(), reading.size() / 3);
  for (const Match& match : kept) EXPECT_EQ(match.reading % 2, 1U);
}

TEST(Icp, SaysThatItsMapDoesNotFixThePose) {
  const Pose3 guess = PoseOf((Vector6() << 0.1, 0.2, 0.3, 0.1, 0.0, 0.0).finished());
  const Cloud room = RoomCloud(300, 5);
  const Map empty{MapOptions{}};
  IcpResult result = Icp(empty, room, guess, IcpOptions{});
  EXPECT_FALSE(result.solved);
  EXPECT_EQ(result.T_map_body.translation, guess.translation);
  EXPECT_EQ(result.iterations, 0);

  Cloud floor = room;  // slides and turns
  floor.points.resize(300), floor.normals.resize(300);
  Map floor_map{MapOptions{}};
  floor_map.Grow(floor);
  EXPECT_FALSE(Icp(floor_map, floor, guess, IcpOptions{}).solved);

  EXPECT_FALSE(Icp(RoomMap(), Cloud{}, guess, IcpOptions{}).solved);
  const Pose3 far{{100.0, 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  EXPECT_FALSE(Icp(RoomMap(), room, far, IcpOptions{}).solved);
}

TEST(Icp, StopsAtTheIterationLimit) {
  const Pose3 guess = PoseOf((Vector6() << 0.3, 0.2, 0.1, 0.1, 0.0, 0.1).finished());
  EXPECT_EQ(Icp(RoomMap(), RoomCloud(300, 6), guess, {.max_iterations = 2}).iterations, 2);
}

TEST(IcpOptions, FaultsAreNamed) {
  EXPECT_EQ(IcpOptions{}.Validate(), "");
  EXPECT_EQ(IcpOptions{.neighbours = 0}.Validate(), "neighbours: must be in 1..100");
  EXPECT_EQ(IcpOptions{.trim_ratio = 1.5}.Validate(), "trim_ratio: must be in (0, 1]");
  EXPECT_EQ(IcpOptions{.max_iterations = 0}.Validate(), "max_iterations: must be in 1..1000");
  EXPECT_EQ(IcpOptions{.min_overlap = -1.0}.Validate(), "min_overlap: must be in [0, 1]");
}

}  // namespace
}  // namespace lcmslam::cloud3d
