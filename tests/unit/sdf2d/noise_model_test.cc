#include "sdf2d/noise_model.h"

#include <cmath>
#include <random>
#include <vector>

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

// A 6 x 4 m room seen from `origin`; sigma(r)^2 = constant^2 + (proportional r)^2.
std::vector<ScanPoint> Room(const Vector2d& origin, double constant_m, double proportional, std::mt19937_64& random) {
  boost::random::normal_distribution<double> normal;
  std::vector<ScanPoint> points;
  for (double angle = -3.1; angle < 3.1; angle += DegToRad(0.36)) {
    const Vector2d u(std::cos(angle), std::sin(angle));
    const double to_x = ((u.x() > 0.0 ? 6.0 : 0.0) - origin.x()) / u.x();
    const double to_y = ((u.y() > 0.0 ? 4.0 : 0.0) - origin.y()) / u.y();
    const double range = std::min(to_x, to_y);
    const double measured = range + std::hypot(constant_m, proportional * range) * normal(random);
    points.push_back({origin + measured * u, measured, 0.0});
  }
  return points;
}

NoiseModel Learn(double constant_m, double proportional, const NoiseOptions& options) {
  std::mt19937_64 random(7);
  NoiseModel model(options);
  for (int scan = 0; scan < 30; ++scan) {
    const Vector2d origin(1.0 + 0.1 * scan, 1.5);
    model.Observe(Room(origin, constant_m, proportional, random), origin);
  }
  return model;
}

TEST(NoiseModel, LearnsConstantNoise) {
  for (const double sigma : {0.003, 0.01, 0.03}) {
    const NoiseModel model = Learn(sigma, 0.0, {});
    for (const double range : {1.0, 2.0, 4.0})
      EXPECT_NEAR(model.Sigma(range) / sigma, 1.0, 0.1) << sigma << " " << range;
  }
}

TEST(NoiseModel, LearnsProportionalNoise) {
  const NoiseModel model = Learn(0.0, 0.03, {});
  for (const double range : {1.5, 3.0, 5.0}) EXPECT_NEAR(model.Sigma(range) / (0.03 * range), 1.0, 0.15) << range;
}

TEST(NoiseModel, NoiseFreeIsTheFloor) {
  const NoiseModel model = Learn(0.0, 0.0, {.floor_m = 0.002});
  EXPECT_NEAR(model.Sigma(3.0), 0.002, 1e-4);
}

TEST(NoiseModel, KeepsWhatItIsTold) {
  const NoiseModel model = Learn(0.05, 0.0, {.estimate = false, .constant_m = 0.01, .proportional = 0.02});
  EXPECT_DOUBLE_EQ(model.Sigma(2.0), std::hypot(0.01, 0.04));
}

TEST(NoiseModel, LittleDataChangesNothing) {
  NoiseModel model({.constant_m = 0.02});
  model.Observe({}, Vector2d::Zero());
  const std::vector<ScanPoint> one = {{Vector2d(1.0, 0.0), 1.0, 0.0}};
  model.Observe(one, Vector2d::Zero());
  const std::vector<ScanPoint> same(100, one.front());  // no triangle
  model.Observe(same, Vector2d::Zero());
  EXPECT_DOUBLE_EQ(model.Sigma(1.0), 0.02);
}

}  // namespace
}  // namespace lcmslam::sdf2d
