#include "octo3d/observability.h"

#include <random>

#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

// Information of points on planes: (point, normal) pairs spread over +-3 m.
Matrix6 InformationOf(const std::vector<Eigen::Vector3d>& normals) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  Matrix6 H = Matrix6::Zero();
  for (const Eigen::Vector3d& n : normals) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
      Vector6 J;
      J << n, p.cross(n);
      H += 1e4 * J * J.transpose();
    }
  }
  return H;
}

TEST(UnobservableDirections, ARoomHasNone) {
  EXPECT_EQ(UnobservableDirections(InformationOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1e-3).cols(), 0);
}

TEST(UnobservableDirections, ACorridorHidesItsLength) {
  const Directions directions = UnobservableDirections(InformationOf({{0, 1, 0}, {0, 0, 1}}), 1e-3);
  ASSERT_EQ(directions.cols(), 1);
  EXPECT_GT(std::abs(directions(0, 0)), 0.999);
}

TEST(UnobservableDirections, OnePlaneHidesThree) {
  const Directions directions = UnobservableDirections(InformationOf({{0, 0, 1}}), 1e-3);
  EXPECT_EQ(directions.cols(), 3);  // x, y, yaw
  EXPECT_LT(directions.row(2).norm(), 1e-3);
}

TEST(UnobservableDirections, NoneWhereNothingIsSeen) {
  EXPECT_EQ(UnobservableDirections(Matrix6::Zero(), 1e-3).cols(), 0);
}

TEST(UnobservableDirections, WhatMayBeNoiseIsNotSeen) {
  Matrix6 information = InformationOf({{0, 1, 0}, {0, 0, 1}});
  Matrix6 noise = Matrix6::Zero();
  noise(0, 0) = 0.01 * information.topLeftCorner<3, 3>().trace();
  information += noise;
  EXPECT_EQ(UnobservableDirections(information, 1e-3).cols(), 0);
  const Directions directions = UnobservableDirections(information, 1e-3, 2.0 * noise);
  ASSERT_EQ(directions.cols(), 1);
  EXPECT_GT(std::abs(directions(0, 0)), 0.999);
}

}  // namespace
}  // namespace lcmslam::octo3d
