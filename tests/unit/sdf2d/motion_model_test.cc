#include "sdf2d/motion_model.h"

#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector3d;

MotionModel MovingModel(const Vector3d& twist) {
  MotionModel model({}, Pose2(1.0, 2.0, 0.5));
  MotionState state = model.Predict(1'000'000);
  state.twist_body = twist;
  state.covariance = 1e-4 * Matrix6d::Identity();
  model.Correct(1'000'000, state);
  return model;
}

void ExpectNear(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_LT((a.inverse() * b).Log().norm(), tolerance);
}

TEST(MotionModel, PredictsConstantTwist) {
  const Vector3d twist(0.8, -0.1, 0.6);
  const MotionModel model = MovingModel(twist);
  const MotionState state = model.Predict(1'250'000);
  ExpectNear(state.T_map_body, Pose2(1.0, 2.0, 0.5) * Pose2::Exp(0.25 * twist), 1e-12);
  EXPECT_TRUE(state.twist_body.isApprox(twist));
}

TEST(MotionModel, WithoutPredictionStartsWhereItWas) {
  MotionModel model({.predict = false, .start_sigma_m = 0.4, .start_sigma_rad = 0.3}, Pose2());
  model.Correct(0, {.T_map_body = Pose2(1.0, 2.0, 0.5), .twist_body = Vector3d(0.8, -0.1, 0.6)});
  const MotionState state = model.Predict(200'000);
  ExpectNear(state.T_map_body, Pose2(1.0, 2.0, 0.5), 1e-15);
  EXPECT_TRUE(state.twist_body.isZero());
  EXPECT_TRUE(state.covariance.diagonal().head<3>().isApprox(Vector3d(0.16, 0.16, 0.09)));
}

// The covariance of the prediction against the propagated error of displaced states.
TEST(MotionModel, CovarianceFollowsTheDerivative) {
  MotionOptions options;
  options.acceleration = options.angular_acceleration = 1e-9;
  const Vector3d twist(0.8, -0.1, 0.6);
  MotionModel model(options, Pose2());
  MotionState state;
  state.T_map_body = Pose2(1.0, 2.0, 0.5);
  state.twist_body = twist;
  state.covariance = Vector6d(1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4).asDiagonal();
  model.Correct(0, state);
  const MotionState predicted = model.Predict(200'000);
  Matrix6d numeric = Matrix6d::Zero();
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Vector6d e = Vector6d::Zero();
    e[i] = kStep;
    MotionState moved = state;
    moved.T_map_body = state.T_map_body * Pose2::Exp(e.head<3>());
    moved.twist_body += e.tail<3>();
    MotionModel other(options, Pose2());
    other.Correct(0, moved);
    const MotionState end = other.Predict(200'000);
    Vector6d column;
    column << (predicted.T_map_body.inverse() * end.T_map_body).Log() / kStep,
        (end.twist_body - predicted.twist_body) / kStep;
    numeric += state.covariance(i, i) * column * column.transpose();
  }
  // The filter takes the derivative by the twist as dt, which differs by the turn within dt.
  EXPECT_LT((predicted.covariance - numeric).norm(), 0.1 * numeric.norm());
}

TEST(MotionModel, UncertaintyGrowsWithTime) {
  const MotionModel model = MovingModel({1.0, 0.0, 0.0});
  double last = 0.0;
  for (const int64_t ms : {50, 100, 200, 400, 900}) {
    const Matrix6d covariance = model.Predict(1'000'000 + 1000 * ms).covariance;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().minCoeff(), 0.0);
    EXPECT_GT(covariance.trace(), last);
    last = covariance.trace();
  }
}

TEST(MotionModel, PauseForgetsTheVelocity) {
  const MotionState state = MovingModel({1.0, 0.0, 0.5}).Predict(60'000'000);
  EXPECT_TRUE(state.twist_body.isZero());
  ExpectNear(state.T_map_body, Pose2(1.0, 2.0, 0.5), 1e-12);
  EXPECT_GT(state.covariance(0, 0), 1.0);
}

TEST(MotionModel, ExtremeStampsAreHarmless) {
  MotionModel model = MovingModel({1.0, 0.0, 0.5});
  for (const int64_t utime :
       {std::numeric_limits<int64_t>::min(), int64_t{0}, int64_t{1'000'000}, std::numeric_limits<int64_t>::max()}) {
    model.AddOdometry(utime, Pose2(1.0, 0.0, 0.0));
    const MotionState state = model.Predict(utime);
    EXPECT_TRUE(state.T_map_body.IsFinite()) << utime;
    EXPECT_TRUE(state.covariance.allFinite()) << utime;
  }
}

TEST(MotionModel, OdometryReplacesTheVelocity) {
  MotionModel model = MovingModel({1.0, 0.0, 0.0});
  const Pose2 T_odom_start(-3.0, 7.0, 2.0), T_moved(0.02, 0.01, -0.1);
  model.AddOdometry(900'000, T_odom_start);
  model.AddOdometry(1'000'000, T_odom_start);
  model.AddOdometry(1'100'000, T_odom_start * T_moved);
  ExpectNear(model.Predict(1'100'000).T_map_body, Pose2(1.0, 2.0, 0.5) * T_moved, 1e-12);
  ExpectNear(model.Predict(1'050'000).T_map_body, Pose2(1.0, 2.0, 0.5) * Interpolate(Pose2(), T_moved, 0.5), 1e-3);
}

TEST(MotionModel, OdometryThatLagsIsExtrapolated) {
  MotionModel model = MovingModel(Vector3d::Zero());
  const Vector3d twist(0.5, 0.0, 0.3);
  for (int64_t utime = 900'000; utime <= 1'080'000; utime += 20'000) {
    model.AddOdometry(utime, Pose2(3.0, 4.0, 1.0) * Pose2::Exp(twist * (1e-6 * static_cast<double>(utime - 900'000))));
  }
  ExpectNear(model.Predict(1'097'000).T_map_body, Pose2(1.0, 2.0, 0.5) * Pose2::Exp(0.097 * twist), 1e-9);
}

TEST(MotionModel, StaleOrBadOdometryIsNotUsed) {
  MotionModel model = MovingModel({1.0, 0.0, 0.0});
  const Pose2 constant_velocity = model.Predict(1'100'000).T_map_body;
  model.AddOdometry(1'000'000, Pose2(5.0, 5.0, 0.0));
  model.AddOdometry(1'000'000, Pose2(6.0, 5.0, 0.0));  // stands still: dropped
  model.AddOdometry(1'090'000, Pose2(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0));
  EXPECT_TRUE(model.Predict(1'100'000).T_map_body.IsFinite());
  MotionModel old = MovingModel({1.0, 0.0, 0.0});
  old.AddOdometry(100'000, Pose2(5.0, 5.0, 0.0));
  ExpectNear(old.Predict(1'100'000).T_map_body, constant_velocity, 1e-12);
}

TEST(MotionModel, RestartKeepsOnlyThePose) {
  MotionModel model = MovingModel({1.0, 0.0, 0.5});
  model.Restart(Pose2(9.0, 8.0, 1.0));
  EXPECT_FALSE(model.started());
  EXPECT_TRUE(model.state().twist_body.isZero());
  ExpectNear(model.Predict(77).T_map_body, Pose2(9.0, 8.0, 1.0), 1e-12);
}

}  // namespace
}  // namespace lcmslam::sdf2d
