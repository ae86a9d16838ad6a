#include "geometry/pose2.h"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

Pose2 RandomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> metres(-10.0, 10.0), radians(-3.1, 3.1);
  return {metres(random), metres(random), radians(random)};
}

void ExpectNear(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
  EXPECT_NEAR(WrapAngle(a.yaw() - b.yaw()), 0.0, tolerance);
}

TEST(Pose2, ComposesLikeHomogeneousMatrices) {
  std::mt19937 random(1);
  const auto matrix = [](const Pose2& T) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
    m.topLeftCorner<2, 2>() = T.rotation();
    m.topRightCorner<2, 1>() = T.translation();
    return m;
  };
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = RandomPose(random), b = RandomPose(random);
    EXPECT_TRUE(matrix(a * b).isApprox(matrix(a) * matrix(b), 1e-12));
    EXPECT_TRUE(matrix(a.inverse()).isApprox(matrix(a).inverse(), 1e-12));
  }
}

TEST(Pose2, LogInvertsExp) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-12.0, 0.49);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d twist = Eigen::Vector3d::Random() * std::pow(10.0, exponent(random));
    EXPECT_TRUE(Pose2::Exp(twist).Log().isApprox(twist, 1e-9)) << twist.transpose();
  }
}

TEST(Pose2, ExpIsManySmallSteps) {
  const Eigen::Vector3d twist(0.7, -0.3, 2.0);
  Pose2 walked;
  for (int i = 0; i < 1000; ++i) walked = walked * Pose2::Exp(twist / 1000.0);
  ExpectNear(walked, Pose2::Exp(twist), 1e-10);
}

TEST(Pose2, InterpolatesTheShortWayRound) {
  const Pose2 middle = Interpolate({0, 0, 3.0}, {2, 4, -3.0}, 0.5);
  ExpectNear(middle, {1, 2, std::numbers::pi}, 1e-12);
}

}  // namespace
}  // namespace lcmslam
