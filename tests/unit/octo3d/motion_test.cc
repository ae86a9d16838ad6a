#include "octo3d/motion.h"

#include <random>

#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

Eigen::Vector3d RandomVector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

MotionState RandomState(std::mt19937_64& random) {
  return {{RandomVector(random, 5.0), ExpRotation(RandomVector(random, 1.5))},
          RandomVector(random, 1.0),
          RandomVector(random, 1.0)};
}

TEST(Rotation, LogUndoesExp) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d v = RandomVector(random, i % 2 == 0 ? 1.7 : 1e-8);
    EXPECT_LT((LogRotation(ExpRotation(v)) - v).norm(), 1e-12);
  }
  EXPECT_EQ(LogRotation(Eigen::Quaterniond::Identity()).norm(), 0.0);
}

TEST(MotionState, AddUndoesDifference) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 50; ++i) {
    const MotionState a = RandomState(random), b = RandomState(random);
    EXPECT_LT(Difference(Add(b, Difference(a, b)), a).norm(), 1e-12);
  }
}

TEST(MotionSegment, PassesThroughItsStates) {
  std::mt19937_64 random(3);
  const MotionState from = RandomState(random);
  const MotionState to = Add(Extrapolate(from, 0.1), 0.02 * Vector12::Ones());
  const MotionSegment segment(from, to, 0.1);
  EXPECT_LT((segment.At(0.0).translation - from.T_map_body.translation).norm(), 1e-12);
  EXPECT_LT((segment.At(1.0).translation - to.T_map_body.translation).norm(), 1e-12);
  EXPECT_LT(AngleBetween(segment.At(0.0).rotation, from.T_map_body.rotation), 1e-9);
  EXPECT_LT(AngleBetween(segment.At(1.0).rotation, to.T_map_body.rotation), 1e-9);

  // velocities, against numeric derivatives
  const double h = 1e-5;
  for (const double end : {0.0, 1.0}) {
    const MotionState& state = end == 0.0 ? from : to;
    const Pose3 before = segment.At(end - h), after = segment.At(end + h);
    EXPECT_LT(((after.translation - before.translation) / (2.0 * h * 0.1) - state.velocity).norm(), 1e-6);
    const Eigen::Vector3d rate = LogRotation(after.rotation * before.rotation.conjugate()) / (2.0 * h * 0.1);
    EXPECT_LT((rate - state.angular_velocity).norm(), 0.01) << "first order in the turn, which is 0.15 rad";
  }
}

TEST(MotionSegment, ConstantVelocityIsAStraightLine) {
  std::mt19937_64 random(4);
  const MotionState from = RandomState(random);
  const MotionSegment segment(from, Extrapolate(from, 0.2), 0.2);
  for (const double s : {0.25, 0.5, 0.75}) {
    const Pose3 expected = Extrapolate(from, 0.2 * s).T_map_body;
    EXPECT_LT((segment.At(s).translation - expected.translation).norm(), 1e-12);
    EXPECT_LT(AngleBetween(segment.At(s).rotation, expected.rotation), 1e-8);
  }
}

TEST(MotionSegment, InfluenceIsTheDerivative) {
  std::mt19937_64 random(5);
  const MotionState from = RandomState(random);
  const MotionState to = Add(Extrapolate(from, 0.1), 0.01 * Vector12::Ones());
  const MotionSegment segment(from, to, 0.1);
  const double h = 1e-6;
  for (const double s : {0.1, 0.5, 0.9}) {
    const Eigen::Vector4d influence = segment.Influence(s);
    for (int block = 0; block < 4; ++block) {
      for (int axis = 0; axis < 6; ++axis) {
        Vector12 step = Vector12::Zero();
        step[6 * (block % 2) + axis] = h;
        const MotionSegment moved =
            block < 2 ? MotionSegment(Add(from, step), to, 0.1) : MotionSegment(from, Add(to, step), 0.1);
        Vector6 derivative;
        derivative << (moved.At(s).translation - segment.At(s).translation) / h,
            LogRotation(moved.At(s).rotation * segment.At(s).rotation.conjugate()) / h;
        EXPECT_NEAR(derivative[axis], influence[block], axis < 3 ? 1e-6 : 0.02)
            << "block " << block << " axis " << axis;
      }
    }
  }
}

TEST(MotionPrior, IsTheInverseOfIntegratedWhiteNoise) {
  const MotionSegment segment(MotionState{}, MotionState{}, 0.25);
  const MotionPrior prior = EvaluateMotionPrior(segment, 2.0, 0.5);
  const Matrix12 covariance = prior.information.inverse();
  // Simulated: noise on the velocity in 10000 steps whose sum has the standard deviation a dt.
  const int steps = 10000;
  const double h = 0.25 / steps, step_var = 2.0 * 0.25 * 2.0 * 0.25 / steps;
  double pp = 0.0, pv = 0.0, vv = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double remaining = h * (steps - i - 0.5);
    pp += step_var * remaining * remaining;
    pv += step_var * remaining;
    vv += step_var;
  }
  EXPECT_NEAR(covariance(0, 0), pp, 1e-6 * pp);
  EXPECT_NEAR(covariance(0, 6), pv, 1e-6 * pv);
  EXPECT_NEAR(covariance(6, 6), vv, 1e-6 * vv);
  EXPECT_NEAR(covariance(9, 9), vv / 16.0, 1e-6 * vv);
  EXPECT_EQ(prior.error.norm(), 0.0);
}

}  // namespace
}  // namespace lcmslam::octo3d
