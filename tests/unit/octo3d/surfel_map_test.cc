#include "octo3d/surfel_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

// Points of a plane through p0 with the given normal, with noise along the normal.
std::vector<Eigen::Vector3f> NoisyPlane(unsigned seed, int n, const Eigen::Vector3d& p0, const Eigen::Vector3d& normal,
                                        double half_m, double sigma_m) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-half_m, half_m);
  const auto gauss = [&] {  // Irwin-Hall: portable
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += (uniform(random) / half_m + 1.0) / 2.0;
    return sum;
  };
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Eigen::Vector3f> points(n);
  for (Eigen::Vector3f& p : points) {
    p = (p0 + uniform(random) * u + uniform(random) * v + sigma_m * gauss() * normal).cast<float>();
  }
  return points;
}

TEST(SurfelMap, LeavesHoldTheStatisticsOfTheirPoints) {
  SurfelMap map{MapOptions{}};
  std::map<std::array<int, 3>, std::vector<Eigen::Vector3d>> oracle;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto points = NoisyPlane(seed, 2000, {0.3, -0.2, 0.1}, Eigen::Vector3d(1, 2, 3).normalized(), 1.0, 0.05);
    map.Insert(points, Eigen::Vector3f::Zero());
    for (const Eigen::Vector3f& p : points) {
      const Eigen::Vector3d cell = (p.cast<double>() / map.options().leaf_m).array().floor();
      oracle[{int(cell.x()), int(cell.y()), int(cell.z())}].push_back(p.cast<double>());
    }
  }
  const auto leaves = map.Leaves();
  ASSERT_EQ(leaves.size(), oracle.size());
  EXPECT_EQ(map.num_leaves(), oracle.size());
  for (const LeafRecord& leaf : leaves) {
    const Eigen::Vector3d cell = (leaf.centre / map.options().leaf_m).array().floor();
    const auto found = oracle.find({int(cell.x()), int(cell.y()), int(cell.z())});
    ASSERT_NE(found, oracle.end());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : found->second) sum += p - leaf.centre;
    EXPECT_EQ(leaf.statistics.count, found->second.size());
    EXPECT_LT((leaf.statistics.sum - sum).norm(), 1e-9);
  }
}

TEST(SurfelMap, FindsThePlaneThatWasInserted) {
  const Eigen::Vector3d normals[] = {{0, 0, 1}, {1, 0, 0}, Eigen::Vector3d(1, -2, 0.5).normalized()};
  for (const Eigen::Vector3d& normal : normals) {
    // p0 on a corner of cells of every scale: the worst place for a grid
    for (const Eigen::Vector3d& p0 : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.31, 0.77, -0.13)}) {
      SurfelMap map{MapOptions{}};
      map.Insert(NoisyPlane(7, 40000, p0, normal, 2.0, 0.03), Eigen::Vector3f(0, 0, 5));
      int tilted = 0;
      const auto probes = NoisyPlane(8, 400, p0, normal, 1.5, 0.01);
      for (const Eigen::Vector3f& probe : probes) {
        const Eigen::Vector3d p = probe.cast<double>();
        const PlaneMatch match = map.Find(p);
        ASSERT_TRUE(match.found);
        tilted += std::abs(match.normal.dot(normal)) < std::cos(0.1);
        const double height = std::abs(match.normal.dot(p - match.mean)) - std::abs(normal.dot(p - p0));
        EXPECT_LT(std::abs(height), 0.02);
      }
      EXPECT_LE(tilted, 8) << "cells clipped at their faces are seldom the best known";
    }
  }
}

TEST(SurfelMap, FindsManyPlanesAsItFindsEach) {
  SurfelMap map{MapOptions{}};
  map.Insert(NoisyPlane(7, 20000, {0, 0, 0}, {0, 0, 1}, 2.0, 0.03), Eigen::Vector3f(0, 0, 5));
  std::vector<Eigen::Vector3d> points{{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {50, 50, 50}};
  // Some next door to the plane's cells, some beyond its border.
  for (const Eigen::Vector3f& p : NoisyPlane(8, 101, {0, 0, 0.1}, {0, 0, 1}, 2.3, 0.2))
    points.push_back(p.cast<double>());
  std::vector<PlaneMatch> planes(points.size());
  map.Find(points, planes);
  int found = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    SCOPED_TRACE(i);
    const PlaneMatch alone = map.Find(points[i]);
    EXPECT_EQ(planes[i].found, alone.found);
    EXPECT_EQ(planes[i].mean, alone.mean);
    EXPECT_EQ(planes[i].normal, alone.normal);
    EXPECT_EQ(planes[i].variance, alone.variance);
    EXPECT_EQ(planes[i].tilt_variance, alone.tilt_variance);
    found += alone.found;
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 102);
  map.Find({}, {});
}

TEST(SurfelMap, VarianceOfAPlaneIsThatOfTheFit) {
  // Many independent maps: the spread of the found height about the truth must be what the match claims (less its model
  // error).
  double squares = 0.0, claimed = 0.0, tilts = 0.0, claimed_tilts = 0.0;
  const int trials = 200;
  MapOptions options;
  options.curvature_per_m = 0.0;
  const Eigen::Vector3d normal(0, 0, 1), p(0.4, 0.4, 0.45);
  for (int trial = 0; trial < trials; ++trial) {
    SurfelMap map(options);
    map.Insert(NoisyPlane(100 + trial, 400, {0.4, 0.4, 0.45}, normal, 0.35, 0.03), Eigen::Vector3f(0, 0, 3));
    const PlaneMatch match = map.Find(p);
    ASSERT_TRUE(match.found);
    const double height = match.normal.dot(match.mean - p) / match.normal.z();
    squares += height * height / trials;
    claimed += match.variance / trials;
    tilts += match.normal.head<2>().squaredNorm() / 2.0 / trials;
    claimed_tilts += match.tilt_variance / trials;
  }
  EXPECT_GT(claimed / squares, 0.5);
  EXPECT_LT(claimed / squares, 4.0) << "the claim allows for clipping too";
  EXPECT_GT(claimed_tilts / tilts, 0.5);
  EXPECT_LT(claimed_tilts / tilts, 4.0);
}

TEST(SurfelMap, ASingleRingIsNoSurface) {
  std::vector<Eigen::Vector3f> ring;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> noise(-0.05F, 0.05F);
  for (int i = 0; i < 2000; ++i) ring.emplace_back(3.0F + noise(random), -1.0F + 0.001F * i, 0.5F);
  SurfelMap map{MapOptions{}};
  map.Insert(ring, Eigen::Vector3f::Zero());
  EXPECT_FALSE(map.Find({3.0, 0.0, 0.5}).found);
  EXPECT_TRUE(map.ChangedSince(0).empty());
}

TEST(SurfelMap, FindNearIsNeverFartherThanTheNearestSurfel) {
  SurfelMap map{MapOptions{}};
  map.Insert(NoisyPlane(1, 20000, {0, 0, 0.1}, {0, 0, 1}, 3.0, 0.01), Eigen::Vector3f(0, 0, 2));
  map.Insert(NoisyPlane(2, 20000, {1.1, 0, 1}, {1, 0, 0}, 1.0, 0.01), Eigen::Vector3f(0, 0, 2));
  const auto surfels = map.ChangedSince(0);  // the finest planar cells: leaves, here
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.3, 0.4, 0.3), Eigen::Vector3d(0.9, 0.1, 0.7)}) {
    const PlaneMatch match = map.FindNear(p, 1);
    ASSERT_TRUE(match.found);
    double nearest = 1e9;
    for (const Surfel& s : surfels) nearest = std::min(nearest, (s.mean.cast<double>() - p).norm());
    EXPECT_LE((match.mean - p).norm(), nearest + 1e-6) << "coarser planes compete too";
  }
  EXPECT_FALSE(map.FindNear({30, 30, 30}, 2).found);
}

TEST(SurfelMap, NormalsFaceTheViewer) {
  SurfelMap map{MapOptions{}};
  map.Insert(NoisyPlane(3, 20000, {0, 0, 0.1}, {0, 0, 1}, 1.0, 0.01), Eigen::Vector3f(0, 0, 2));
  const auto surfels = map.ChangedSince(0);
  ASSERT_FALSE(surfels.empty());
  for (const Surfel& s : surfels) EXPECT_GT(s.normal.z(), 0.9F);
}

TEST(SurfelMap, ChangedSinceGivesWhatChanged) {
  SurfelMap map{MapOptions{}};
  map.Insert(NoisyPlane(3, 20000, {0, 0, 0.1}, {0, 0, 1}, 1.0, 0.01), Eigen::Vector3f(0, 0, 2));
  const uint32_t revision = map.revision();
  EXPECT_TRUE(map.ChangedSince(revision).empty());
  map.Insert(NoisyPlane(4, 5000, {10, 0, 0.1}, {0, 0, 1}, 0.5, 0.01), Eigen::Vector3f(10, 0, 2));
  const auto changed = map.ChangedSince(revision);
  ASSERT_FALSE(changed.empty());
  for (const Surfel& s : changed) EXPECT_GT(s.mean.x(), 9.0F);
  EXPECT_GT(map.ChangedSince(0).size(), changed.size());
}

// Cells are cubes whose corners are whole multiples of their edge: who receives a surfel finds its cell from its mean.
TEST(SurfelMap, SurfelsLieOnTheirPlaneInCellsOfTheirOwn) {
  SurfelMap map{MapOptions{}};
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0, 1).normalized();
  map.Insert(NoisyPlane(5, 20000, {0, 0, 0.4}, normal, 2.0, 0.02), Eigen::Vector3f(0, 0, 2));  // crosses cell borders
  std::set<std::array<long, 4>> cells;
  for (const Surfel& s : map.ChangedSince(0)) {
    const auto cell = [&](int axis) { return std::lround(std::floor(s.mean[axis] / s.cell_m)); };
    EXPECT_TRUE(cells.insert({cell(0), cell(1), cell(2), std::lround(s.cell_m / 0.2F)}).second);
    EXPECT_NEAR(normal.dot(s.mean.cast<double>() - Eigen::Vector3d(0, 0, 0.4)), 0.0, 0.03);
  }
  EXPECT_GT(cells.size(), 100U);
}

TEST(SurfelMap, InTurnGoesRoundTheWholeMap) {
  SurfelMap map{MapOptions{}};
  size_t turn = 0;
  EXPECT_TRUE(map.InTurn(turn, 10).empty());
  map.Insert(NoisyPlane(3, 20000, {0, 0, 0.1}, {0, 0, 1}, 3.0, 0.01), Eigen::Vector3f(0, 0, 2));
  const auto key = [](const Surfel& s) { return std::array<float, 3>{s.mean.x(), s.mean.y(), s.mean.z()}; };
  std::set<std::array<float, 3>> all, seen;
  for (const Surfel& s : map.ChangedSince(0)) all.insert(key(s));
  const size_t rounds = 2 * all.size() / 10;
  for (size_t i = 0; i < rounds; ++i) {
    const auto some = map.InTurn(turn, 10);
    EXPECT_GE(some.size(), 10U);
    EXPECT_LT(some.size(), all.size());
    for (const Surfel& s : some) seen.insert(key(s));
  }
  EXPECT_EQ(seen, all);
}

TEST(SurfelMap, RestoreBuildsTheSameLeaves) {
  SurfelMap map{MapOptions{}};
  map.Insert(NoisyPlane(3, 20000, {0, 0, 0.1}, {1, 0, 1}, 1.0, 0.02), Eigen::Vector3f(0, 0, 2));
  SurfelMap copy{MapOptions{}};
  copy.Restore(map.Leaves(), map.viewpoints());
  EXPECT_EQ(copy.num_cells(), map.num_cells());
  const auto a = map.Leaves(), b = copy.Leaves();
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].statistics, b[i].statistics);
  EXPECT_EQ(copy.ChangedSince(0).size(), map.ChangedSince(0).size());
}

TEST(SurfelMap, SkipsWhatIsNotFiniteOrTooFar) {
  SurfelMap map{MapOptions{}};
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  map.Insert(std::vector<Eigen::Vector3f>{{nan, 0, 0}, {0, inf, 0}, {0, 0, -inf}, {1e9F, 0, 0}, {-7000, 0, 0}},
             Eigen::Vector3f::Zero());
  EXPECT_EQ(map.num_cells(), 0U);
  EXPECT_FALSE(map.Find({nan, 0, 0}).found);
  EXPECT_FALSE(map.FindNear({nan, 0, 0}, 1).found);
  map.Insert({}, Eigen::Vector3f::Zero());
  EXPECT_EQ(map.num_cells(), 0U);
}

TEST(SurfelMap, WorksWithOneLevel) {
  MapOptions options;
  options.levels = 1;
  options.leaf_m = 0.5;
  SurfelMap map(options);
  map.Insert(NoisyPlane(3, 5000, {0, 0, 0.1}, {0, 0, 1}, 1.0, 0.02), Eigen::Vector3f(0, 0, 2));
  EXPECT_TRUE(map.Find({0.2, 0.2, 0.1}).found);
  EXPECT_EQ(map.num_cells(), map.num_leaves());
}

}  // namespace
}  // namespace lcmslam::octo3d
