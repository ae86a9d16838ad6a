#include "baselines/cloud3d_kd_tree.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lcmslam::cloud3d {
namespace {

std::vector<Eigen::Vector3f> RandomPoints(int n, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&] { return static_cast<float>(random() >> 40) * 0x1p-24F * 10.0F; };
  std::vector<Eigen::Vector3f> points(n);
  for (Eigen::Vector3f& p : points) p = {draw(), draw(), draw()};
  return points;
}

std::vector<float> BruteForce(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& p, float max_m) {
  std::vector<float> distances_m2;
  for (const Eigen::Vector3f& q : points) {
    if ((p - q).squaredNorm() < max_m * max_m) distances_m2.push_back((p - q).squaredNorm());
  }
  std::ranges::sort(distances_m2);
  return distances_m2;
}

TEST(KdTree, FindsWhatBruteForceFinds) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(2000, 1);
  const KdTree tree(points);
  for (const float max_m : {0.3F, 1.5F, std::numeric_limits<float>::max()}) {
    for (const Eigen::Vector3f& p : RandomPoints(100, 2)) {
      const std::vector<float> all_m2 = BruteForce(points, p, max_m);
      for (const size_t k : {1, 3, 12}) {
        std::vector<Neighbour> found(k);
        const size_t count = tree.Nearest(p, max_m, 0.0F, found);
        ASSERT_EQ(count, std::min(k, all_m2.size()));
        for (size_t i = 0; i < count; ++i) {
          EXPECT_FLOAT_EQ(found[i].distance_m2, all_m2[i]);
          EXPECT_FLOAT_EQ((points[found[i].index] - p).squaredNorm(), all_m2[i]);
        }
      }
    }
  }
}

TEST(KdTree, EpsilonBoundsTheError) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(2000, 3);
  const KdTree tree(points);
  bool any_farther = false;
  for (const Eigen::Vector3f& p : RandomPoints(500, 4)) {
    Neighbour found;
    ASSERT_EQ(tree.Nearest(p, 100.0F, 1.0F, {&found, 1}), 1);
    const float nearest_m2 = BruteForce(points, p, 100.0F).front();
    EXPECT_LE(found.distance_m2, 4.001F * nearest_m2);
    any_farther |= found.distance_m2 > nearest_m2;
  }
  EXPECT_TRUE(any_farther) << "epsilon saves no work";
}

TEST(KdTree, AwkwardSets) {
  Neighbour found[3];
  EXPECT_EQ(KdTree().Nearest({0, 0, 0}, 1.0F, 0.0F, found), 0);
  const KdTree one({{1, 2, 3}});
  EXPECT_EQ(one.Nearest({1, 2, 4}, 2.0F, 0.0F, found), 1);
  EXPECT_EQ(one.Nearest({1, 2, 4}, 1.0F, 0.0F, found), 0) << "exactly at the limit";
  EXPECT_EQ(one.Nearest({1, 2, 3}, 1.0F, 0.0F, {}), 0);
  EXPECT_EQ(one.Nearest({std::numeric_limits<float>::quiet_NaN(), 0, 0}, 1.0F, 0.0F, found), 0);
  const KdTree same(std::vector<Eigen::Vector3f>(50, {1, 1, 1}));
  EXPECT_EQ(same.Nearest({1, 1, 1}, 1.0F, 0.0F, found), 3);
}

}  // namespace
}  // namespace lcmslam::cloud3d
