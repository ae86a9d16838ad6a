#include "sdf2d/surface.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

const NoiseModel& FixedNoise(double sigma_m) {
  static NoiseModel model{NoiseOptions{}};
  model = NoiseModel({.estimate = false, .constant_m = sigma_m});
  return model;
}

// End points on the wall {p : normal.p = offset} for beams from the origin.
std::vector<Vector2d> Wall(const Vector2d& normal, double offset_m, double first_rad, double last_rad, double sigma_m,
                           std::mt19937_64& random) {
  boost::random::normal_distribution<double> noise;
  std::vector<Vector2d> points;
  for (double angle = first_rad; angle < last_rad; angle += 0.00628) {
    const Vector2d u(std::cos(angle), std::sin(angle));
    points.push_back((offset_m / normal.dot(u) + sigma_m * noise(random)) * u);
  }
  return points;
}

TEST(Surface, CornerGivesTwoExactLines) {
  std::mt19937_64 random(1);
  std::vector<Vector2d> points = Wall({1.0, 0.0}, 2.0, -0.5, 0.5, 0.0, random);  // x = 2, then y = 2 tan(0.5)
  const double y = 2.0 * std::tan(0.5);
  const std::vector<Vector2d> second = Wall({0.0, 1.0}, y, 0.5, 1.2, 0.0, random);
  points.insert(points.end(), second.begin(), second.end());
  const auto lines = ExtractSurface(points, Vector2d::Zero(), FixedNoise(0.001), {});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].normal.isApprox(Vector2d(-1.0, 0.0), 1e-4));
  EXPECT_TRUE(lines[1].normal.isApprox(Vector2d(0.0, -1.0), 1e-4));
  EXPECT_LT((lines[0].end - Vector2d(2.0, y)).norm(), 0.05) << "ends within a beam of the corner";
  EXPECT_LT((lines[1].begin - Vector2d(2.0, y)).norm(), 0.05);
  EXPECT_EQ(lines[0].num_beams + lines[1].num_beams, static_cast<int>(points.size()));
}

TEST(Surface, PiecesAreNoLongerThanAsked) {
  std::mt19937_64 random(1);
  const std::vector<Vector2d> points = Wall({1.0, 0.0}, 2.0, -0.5, 0.5, 0.0, random);
  const auto lines = ExtractSurface(points, Vector2d::Zero(), FixedNoise(0.001), {.min_beams = 2, .max_piece_m = 0.2});
  EXPECT_GE(lines.size(), 4.0 * std::tan(0.5) / 0.2);
  for (const SurfaceLine& line : lines) EXPECT_LE((line.end - line.begin).norm(), 0.2 + 1e-9);
}

// Oblique wall, noise as large as the window: total least squares on the points would tilt it by several sigmas.
TEST(Surface, LinesAreUnbiasedAndTheirVarianceIsTrue) {
  constexpr int kTrials = 400;
  constexpr double kSigma_m = 0.06;
  const Vector2d normal = Vector2d(std::cos(0.9), std::sin(0.9));
  double sum = 0.0, sum_squares = 0.0, tilt_rad = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::mt19937_64 random(100 + trial);
    const auto points = Wall(normal, 1.5, -0.15, 0.15, kSigma_m, random);
    const auto lines = ExtractSurface(points, Vector2d::Zero(), FixedNoise(kSigma_m), {.split_chi2 = 1e9});
    ASSERT_EQ(lines.size(), 1U);
    const SurfaceLine& line = lines.front();
    const double error = normal.dot(line.begin) - 1.5;  // at t = 0
    sum += error / std::sqrt(line.variance[0]);
    sum_squares += error * error / line.variance[0];
    EXPECT_LT(line.normal.dot(normal), 0.0) << "towards the lidar";
    tilt_rad += std::asin(normal.y() * line.normal.x() - normal.x() * line.normal.y());
  }
  EXPECT_LT(std::abs(sum / kTrials), 0.2) << "mean error, in sigmas";
  EXPECT_NEAR(sum_squares / kTrials, 1.0, 0.25) << "mean squared error, in variances";
  EXPECT_LT(std::abs(tilt_rad / kTrials), 0.01);
}

TEST(Surface, VarianceGrowsAwayFromTheMiddle) {
  std::mt19937_64 random(3);
  const auto points = Wall({1.0, 0.0}, 2.0, -0.4, 0.4, 0.01, random);
  const auto lines = ExtractSurface(points, Vector2d::Zero(), FixedNoise(0.01), {});
  ASSERT_EQ(lines.size(), 1U);
  const double length = (lines[0].end - lines[0].begin).norm();
  const auto variance = [&](double t) { return lines[0].variance.dot(Eigen::Vector3d(1.0, t, t * t)); };
  EXPECT_GT(variance(0.0), variance(0.5 * length));
  EXPECT_GT(variance(length), variance(0.5 * length));
  // In the middle of n beams: about sigma^2 / n.
  EXPECT_NEAR(variance(0.5 * length) / (1e-4 / static_cast<double>(points.size())), 1.0, 0.3);
}

TEST(Surface, GapsAreNotBridged) {
  std::mt19937_64 random(4);
  std::vector<Vector2d> points = Wall({1.0, 0.0}, 2.0, -0.5, -0.2, 0.0, random);
  const auto second = Wall({1.0, 0.0}, 2.0, 0.2, 0.5, 0.0, random);
  points.insert(points.end(), second.begin(), second.end());
  EXPECT_EQ(ExtractSurface(points, Vector2d::Zero(), FixedNoise(0.01), {}).size(), 2U);
}

TEST(Surface, TooLittleIsNothing) {
  EXPECT_TRUE(ExtractSurface({}, Vector2d::Zero(), FixedNoise(0.01), {}).empty());
  const std::vector<Vector2d> one = {{1.0, 0.0}};
  EXPECT_TRUE(ExtractSurface(one, Vector2d::Zero(), FixedNoise(0.01), {}).empty());
  const std::vector<Vector2d> at_lidar(50, Vector2d::Zero());
  EXPECT_TRUE(ExtractSurface(at_lidar, Vector2d::Zero(), FixedNoise(0.01), {}).empty());
  const std::vector<Vector2d> same(50, Vector2d(1.0, 1.0));
  EXPECT_TRUE(ExtractSurface(same, Vector2d::Zero(), FixedNoise(0.01), {}).empty());
}

}  // namespace
}  // namespace lcmslam::sdf2d
