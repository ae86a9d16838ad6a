#include "trajectory/alignment.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trajectory/alignment_ceres.h"
#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::HasSubstr;

double SumSquares(std::span<const PosePair> pairs, const Pose3& T_world_map) {
  double sum = 0.0;
  for (const PosePair& p : pairs) sum += (p.reference.translation - T_world_map * p.estimate.translation).squaredNorm();
  return sum;
}

double Difference(const Pose3& a, const Pose3& b) {
  return (a.translation - b.translation).norm() + AngleBetween(a.rotation, b.rotation);
}

std::vector<PosePair> PlanarPairs(uint64_t seed, double sigma) {
  testing::Noise noise(seed);
  const Pose2 T_map_world(noise.Uniform(-9, 9), noise.Uniform(-9, 9), noise.Uniform(-3, 3));
  std::vector<PosePair> pairs;
  for (int k = 0; k < 200; ++k) {
    const Pose2 reference = ToPose2(testing::Drive(0.1 * k));
    const Pose2 estimate = T_map_world * reference * Pose2(noise.Gauss(sigma), noise.Gauss(sigma), noise.Gauss(sigma));
    pairs.push_back({k * 100'000, ToPose3(estimate), ToPose3(reference)});
  }
  return pairs;
}

TEST(Align, Se3AgreesWithEigensUmeyama) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto pairs = testing::NoisyPairs(100, seed, 0.05);
    Eigen::Matrix3Xd estimate(3, pairs.size()), reference(3, pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
      estimate.col(static_cast<Eigen::Index>(i)) = pairs[i].estimate.translation;
      reference.col(static_cast<Eigen::Index>(i)) = pairs[i].reference.translation;
    }
    const Eigen::Matrix4d expected = Eigen::umeyama(estimate, reference, false);
    const Alignment a = Align(pairs, AlignmentKind::kSe3);
    ASSERT_EQ(a.status, AlignmentStatus::kOk);
    EXPECT_TRUE(a.unobservable_axes.empty());
    EXPECT_LT((a.T_world_map.rotation.toRotationMatrix() - expected.topLeftCorner<3, 3>()).norm(), 1e-10);
    EXPECT_LT((a.T_world_map.translation - expected.topRightCorner<3, 1>()).norm(), 1e-10);
  }
}

TEST(Align, Se2AgreesWithEigensUmeyama) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto pairs = PlanarPairs(seed, 0.05);
    Eigen::MatrixXd estimate(2, pairs.size()), reference(2, pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
      estimate.col(static_cast<Eigen::Index>(i)) = pairs[i].estimate.translation.head<2>();
      reference.col(static_cast<Eigen::Index>(i)) = pairs[i].reference.translation.head<2>();
    }
    const Eigen::MatrixXd expected = Eigen::umeyama(estimate, reference, false);
    const Pose2 actual = ToPose2(Align(pairs, AlignmentKind::kSe2).T_world_map);
    EXPECT_LT((actual.rotation() - expected.topLeftCorner(2, 2)).norm(), 1e-10);
    EXPECT_LT((actual.translation() - expected.topRightCorner(2, 1)).norm(), 1e-10);
  }
}

TEST(Align, NoMotionNearbyIsBetter) {
  const auto pairs = testing::NoisyPairs(200, 4, 0.1);
  for (const AlignmentKind kind : {AlignmentKind::kYaw, AlignmentKind::kSe3}) {
    SCOPED_TRACE(Name(kind));
    const Pose3 T = Align(pairs, kind).T_world_map;
    const double best = SumSquares(pairs, T);
    testing::Noise noise(5);
    for (int k = 0; k < 500; ++k) {
      Pose3 near = T;
      near.translation += noise.Gauss3(1e-3);
      const Eigen::Vector3d turn = noise.Gauss3(1e-3);
      const bool yaw_only = kind == AlignmentKind::kYaw;
      near.rotation = testing::RotationVector(yaw_only ? Eigen::Vector3d(0, 0, turn.z()) : turn) * near.rotation;
      EXPECT_GE(SumSquares(pairs, near), best);
    }
  }
}

TEST(Align, CeresAgreesWithClosedForm) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed + 100);
    for (const AlignmentKind kind : {AlignmentKind::kYaw, AlignmentKind::kSe2, AlignmentKind::kSe3}) {
      SCOPED_TRACE(Name(kind));
      const bool planar = kind == AlignmentKind::kSe2, level = kind == AlignmentKind::kYaw;
      const auto pairs = planar ? PlanarPairs(seed, 0.03) : testing::NoisyPairs(150, seed, 0.03, level);
      const Pose3 closed = Align(pairs, kind).T_world_map;
      Pose3 guess = closed;
      guess.translation += Eigen::Vector3d(noise.Gauss(0.3), noise.Gauss(0.3), planar ? 0.0 : noise.Gauss(0.3));
      guess.rotation = testing::RotationVector({0, 0, noise.Gauss(0.5)}) * guess.rotation;
      const CeresAlignment by_ceres = AlignByCeres(pairs, kind, guess);
      ASSERT_TRUE(by_ceres.converged);
      EXPECT_LT(Difference(by_ceres.T_world_map, closed), 1e-8);
    }
  }
}

TEST(AlignByCeres, RobustLossIgnoresGlitches) {
  auto pairs = testing::NoisyPairs(300, 6, 0.002);
  const Pose3 clean = Align(pairs, AlignmentKind::kSe3).T_world_map;
  for (size_t i = 0; i < pairs.size(); i += 10) pairs[i].reference.translation.x() += 3.0;
  const Pose3 plain = Align(pairs, AlignmentKind::kSe3).T_world_map;
  const CeresAlignment robust = AlignByCeres(pairs, AlignmentKind::kSe3, plain, {.huber_m = 0.01});
  ASSERT_TRUE(robust.converged);
  EXPECT_GT(Difference(plain, clean), 0.1);
  EXPECT_LT(Difference(robust.T_world_map, clean), 0.003);
  EXPECT_FALSE(AlignByCeres({}, AlignmentKind::kSe3, clean).converged);
  EXPECT_FALSE(AlignByCeres(pairs, AlignmentKind::kFirst, clean).converged);
}

TEST(Align, FirstMakesTheFirstPosesEqual) {
  const auto pairs = testing::NoisyPairs(10, 7, 0.5);
  const Pose3 T = Align(pairs, AlignmentKind::kFirst).T_world_map;
  EXPECT_LT(Difference(T * pairs[0].estimate, pairs[0].reference), 1e-9);
  EXPECT_EQ(Difference(Align(pairs, AlignmentKind::kNone).T_world_map, Pose3{}), 0.0);
}

TEST(Align, StandingStillTakesTheOrientations) {
  testing::Noise noise(8);
  const Pose3 T_world_map{{1, 2, 0.5}, testing::RotationVector({0, 0, 1.2})};
  std::vector<PosePair> pairs;
  for (int k = 0; k < 100; ++k) {
    const Pose3 at{noise.Gauss3(0.002), testing::RotationVector({0, 0, 0.1 * k})};
    pairs.push_back({k, at, T_world_map * at});
  }
  for (const AlignmentKind kind : {AlignmentKind::kYaw, AlignmentKind::kSe2, AlignmentKind::kSe3}) {
    SCOPED_TRACE(Name(kind));
    const Alignment a = Align(pairs, kind);
    ASSERT_EQ(a.status, AlignmentStatus::kOk);
    EXPECT_EQ(a.unobservable_axes.size(), kind == AlignmentKind::kSe3 ? 3u : 1u);
    EXPECT_THAT(DescribeUnobservable(a), HasSubstr("standing still"));
    EXPECT_LT(AngleBetween(a.T_world_map.rotation, T_world_map.rotation), 1e-9);
  }
}

TEST(Align, StraightLineTakesTheTurnAboutItFromTheOrientations) {
  const Pose3 T_world_map{{3, 1, 2}, testing::RotationVector({0.4, -0.8, 1.0})};
  std::vector<PosePair> pairs;
  for (int k = 0; k < 100; ++k) {
    const Pose3 at{{0.1 * k, 0.2 * k, -0.05 * k}, testing::RotationVector({0.01 * k, 0.3, 0.0})};
    pairs.push_back({k, at, T_world_map * at});
  }
  const Alignment a = Align(pairs, AlignmentKind::kSe3);
  ASSERT_EQ(a.unobservable_axes.size(), 1u);
  const Eigen::Vector3d direction = T_world_map.rotation * Eigen::Vector3d(0.1, 0.2, -0.05).normalized();
  EXPECT_NEAR(std::abs(a.unobservable_axes[0].dot(direction)), 1.0, 1e-9);
  EXPECT_THAT(DescribeUnobservable(a), HasSubstr("straight line: rotation about ("));
  EXPECT_LT(Difference(a.T_world_map, T_world_map), 1e-9);
  EXPECT_TRUE(Align(pairs, AlignmentKind::kYaw).unobservable_axes.empty()) << "yaw is observable on a line";
}

TEST(Align, OnePairAndNone) {
  const std::vector<PosePair> one = {{0, {}, {{1, 2, 3}, testing::RotationVector({0, 0, 0.5})}}};
  const Alignment a = Align(one, AlignmentKind::kSe3);
  EXPECT_EQ(a.status, AlignmentStatus::kOk);
  EXPECT_LT(Difference(a.T_world_map, one[0].reference), 1e-12);
  EXPECT_EQ(a.unobservable_axes.size(), 3u);
  EXPECT_EQ(Align({}, AlignmentKind::kSe3).status, AlignmentStatus::kNoPairs);
}

TEST(Align, MirroredPathGivesARotation) {
  auto pairs = testing::NoisyPairs(100, 9, 0.0);
  for (PosePair& p : pairs) p.estimate.translation = p.reference.translation.cwiseProduct(Eigen::Vector3d(-1, 1, 1));
  EXPECT_NEAR(Align(pairs, AlignmentKind::kSe3).T_world_map.rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
}

TEST(AlignmentKind, NamesComeBack) {
  for (const char* name : {"none", "first", "yaw", "se2", "se3"}) {
    ASSERT_TRUE(ParseAlignmentKind(name));
    EXPECT_EQ(Name(*ParseAlignmentKind(name)), name);
  }
  EXPECT_FALSE(ParseAlignmentKind("sim3"));
}

}  // namespace
}  // namespace lcmslam
