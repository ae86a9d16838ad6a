#include "baselines/cloud3d_filters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <Eigen/SVD>
#include <gtest/gtest.h>

namespace lcmslam::cloud3d {
namespace {

// Evenly over [-size, size)^3.
std::vector<Eigen::Vector3f> RandomPoints(int n, float size, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&] { return size * (static_cast<float>(random() >> 40) * 0x1p-23F - 1.0F); };
  std::vector<Eigen::Vector3f> points(n);
  for (Eigen::Vector3f& p : points) p = {draw(), draw(), draw()};
  return points;
}

TEST(Filters, ReturnsInRangeDropsWhatIsNoReturn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  Sweep sweep;
  for (const float x : {0.0F, 0.2F, 0.5F, 5.0F, 99.0F, 101.0F, kNan, kInf, -kInf, 1e30F}) {
    sweep.points.push_back({.x = x});
  }
  sweep.points.push_back({.x = 1.0F, .y = kNan});
  const std::vector<Eigen::Vector3f> points = ReturnsInRange(sweep, 0.3, 100.0);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].x(), 0.5F);
  EXPECT_EQ(points[2].x(), 99.0F);
}

TEST(Filters, RandomSampleKeepsItsShareInOrder) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(10000, 5.0F, 1);
  std::mt19937_64 random(7), same(7);
  const std::vector<Eigen::Vector3f> kept = RandomSample(points, 0.3, random);
  EXPECT_NEAR(static_cast<double>(kept.size()), 3000.0, 200.0);  // 4 sigma
  EXPECT_EQ(kept, RandomSample(points, 0.3, same));
  size_t at = 0;
  for (const Eigen::Vector3f& p : kept) {
    while (at < points.size() && points[at] != p) ++at;
  }
  EXPECT_LT(at, points.size()) << "not in order";
  EXPECT_EQ(RandomSample(points, 1.0, random), points);
}

TEST(Filters, ASampledCloudKeepsItsPairs) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(1000, 5.0F, 2);
  std::mt19937_64 random(7);
  const Cloud cloud = RandomSample(Cloud{.points = points, .normals = points}, 0.5, random);
  EXPECT_EQ(cloud.points, cloud.normals);
  EXPECT_NEAR(static_cast<double>(cloud.size()), 500.0, 64.0);
}

TEST(Filters, VoxelMeansAreTheMeansOfTheCells) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(5000, 1.0F, 3);
  std::map<std::tuple<int, int, int>, std::pair<Eigen::Vector3d, int>> cells;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Array3i c = (p.array().cast<double>() / 0.25).floor().cast<int>();
    auto& [sum, count] = cells.try_emplace({c.x(), c.y(), c.z()}, Eigen::Vector3d::Zero(), 0).first->second;
    sum += p.cast<double>();
    ++count;
  }
  const std::vector<Eigen::Vector3f> means = VoxelMeans(points, 0.25);
  ASSERT_EQ(means.size(), cells.size());
  auto mean = means.begin();
  for (const auto& [cell, expected] : cells) {
    EXPECT_LT((mean++->cast<double>() - expected.first / expected.second).norm(), 1e-6);
  }
  EXPECT_TRUE(VoxelMeans({}, 0.25).empty());
}

TEST(Filters, NormalsAreThoseOfThePlaneThroughTheNearestPoints) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(300, 2.0F, 4);
  const Cloud cloud = WithNormals(points, 8);
  ASSERT_EQ(cloud.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    std::vector<Eigen::Vector3f> nearest = points;
    std::ranges::sort(nearest, {}, [&](const Eigen::Vector3f& q) { return (q - points[i]).squaredNorm(); });
    Eigen::Matrix<double, 3, 8> offsets;
    for (int k = 0; k < 8; ++k) offsets.col(k) = nearest[k].cast<double>();
    offsets.colwise() -= Eigen::Vector3d(offsets.rowwise().mean());
    const Eigen::JacobiSVD<Eigen::Matrix<double, 3, 8>> svd(offsets, Eigen::ComputeFullU);
    const Eigen::Vector3d normal = svd.matrixU().col(2);
    EXPECT_NEAR(std::abs(normal.dot(cloud.normals[i].cast<double>())), 1.0, 1e-4);
    EXPECT_NEAR(cloud.normals[i].norm(), 1.0, 1e-5);
    EXPECT_LE(cloud.normals[i].dot(points[i]), 0.0F) << "looks away from the sensor";
  }
}

TEST(Filters, NoPlaneNoNormal) {
  std::vector<Eigen::Vector3f> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(1.0F + 0.1F * i, 2.0F, 0.5F);
  EXPECT_EQ(WithNormals(line, 12).size(), 0U);
  EXPECT_EQ(WithNormals({}, 12).size(), 0U);
  EXPECT_EQ(WithNormals({{1, 2, 3}, {2, 2, 3}}, 12).size(), 0U);
  EXPECT_EQ(WithNormals(std::vector<Eigen::Vector3f>(20, {1, 1, 1}), 12).size(), 0U);
}

TEST(FilterOptions, FaultsAreNamed) {
  EXPECT_EQ(FilterOptions{}.Validate(), "");
  EXPECT_EQ(FilterOptions{.min_range_m = NAN}.Validate(), "min_range_m: must not be negative");
  EXPECT_EQ(FilterOptions{.keep_ratio = 0.0}.Validate(), "keep_ratio: must be in (0, 1]");
  EXPECT_EQ(FilterOptions{.voxel_m = -1.0}.Validate(), "voxel_m: must be 0 or in [0.001, 100]");
  EXPECT_EQ(FilterOptions{.normal_neighbours = 2}.Validate(), "normal_neighbours: must be in 3..100");
}

}  // namespace
}  // namespace lcmslam::cloud3d
