#include "trajectory/evaluate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "unit/trajectory/matrix_oracle.h"
#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

struct Recording {
  Trajectory estimate, reference;
};

Recording Noisy(Pose3 (*motion)(double), double height_m) {
  testing::Noise noise(5);
  Recording run;
  run.reference = testing::Sample(
      [&](double t_s) {
        Pose3 pose = motion(t_s);
        pose.translation.z() += height_m;
        return pose;
      },
      30.0, 0.01);
  const Pose3 T_map_world = ToPose3({1.0, 2.0, 0.5});
  run.estimate = testing::Sample(
      [&](double t_s) {
        return T_map_world * motion(t_s) * ToPose3({noise.Gauss(0.01), noise.Gauss(0.01), noise.Gauss(0.01)});
      },
      31.0, 0.1);
  return run;
}

// The whole way once more with matrices: interpolation is exact here because stamps coincide.
TEST(Evaluate, AbsoluteErrorAgreesWithMatrices) {
  const Recording run = Noisy(testing::Flight, 0.0);
  const Evaluation e = Evaluate(run.estimate, run.reference);
  ASSERT_EQ(e.status, EvaluationStatus::kOk);
  EXPECT_EQ(e.alignment.kind, AlignmentKind::kSe3);
  Eigen::Matrix3Xd estimate(3, 301), reference(3, 301);
  for (Eigen::Index k = 0; k <= 300; ++k) {
    estimate.col(k) = run.estimate[static_cast<size_t>(k)].pose.translation;
    reference.col(k) = run.reference[static_cast<size_t>(10 * k)].pose.translation;
  }
  const Eigen::Matrix4d T = Eigen::umeyama(estimate, reference, false);
  double mean = 0.0, squares = 0.0, angle = 0.0;
  for (Eigen::Index k = 0; k <= 300; ++k) {
    const Eigen::Vector4d moved = T * Eigen::Vector4d(estimate.col(k).homogeneous());
    const double error = (reference.col(k) - moved.head<3>()).norm();
    mean += error / 301;
    squares += error * error / 301;
    angle += testing::Angle(testing::Matrix(run.reference[static_cast<size_t>(10 * k)].pose).inverse() * T *
                            testing::Matrix(run.estimate[static_cast<size_t>(k)].pose)) /
             301;
  }
  EXPECT_EQ(e.absolute.translation_m.count, 301);
  EXPECT_NEAR(e.absolute.translation_m.mean, mean, 1e-9);
  EXPECT_NEAR(e.absolute.translation_m.rmse, std::sqrt(squares), 1e-9);
  EXPECT_NEAR(e.absolute.rotation_rad.mean, angle, 1e-9);
  EXPECT_EQ(e.association.after, 10);
  EXPECT_NEAR(e.duration_s, 30.0, 1e-9);
}

TEST(Evaluate, PlanarEstimateIsJudgedInThePlane) {
  const Recording run = Noisy(testing::Drive, 1.3);
  const Evaluation e = Evaluate(run.estimate, run.reference);
  ASSERT_EQ(e.status, EvaluationStatus::kOk);
  EXPECT_EQ(e.alignment.kind, AlignmentKind::kSe2);
  EXPECT_LT(e.absolute.translation_m.mean, 0.02);
  EXPECT_EQ(e.association.pairs[5].reference.translation.z(), 0.0);
  ASSERT_EQ(e.relative_over_time.size(), 3u);
  ASSERT_EQ(e.relative_over_distance.size(), 4u);
  EXPECT_GT(e.relative_over_time[1].error.translation_m.count, 280);
  EXPECT_EQ(e.kitti_translation_ratio.count, 0);
}

TEST(Evaluate, CalibrateRemovesOffsetAndLeverArm) {
  const Pose3 marker{{0.1, 0.2, 0.0}, testing::RotationVector({0, 0, 1.0})};
  Recording run;
  run.estimate = testing::Sample(testing::Drive, 60.0, 0.1);
  run.reference = testing::Sample([&](double t_s) { return testing::Drive(t_s - 0.05) * marker; }, 60.0, 0.01);
  const Evaluation plain = Evaluate(run.estimate, run.reference);
  const Evaluation calibrated = Evaluate(run.estimate, run.reference, {.calibrate = true});
  ASSERT_EQ(calibrated.status, EvaluationStatus::kOk);
  EXPECT_GT(plain.absolute.translation_m.mean, 0.05);
  EXPECT_LT(calibrated.absolute.translation_m.mean, 1e-4);
  EXPECT_LT(calibrated.absolute.rotation_rad.mean, 1e-4);
  EXPECT_NEAR(calibrated.calibration->time_offset_s, 0.05, 1e-4);
}

TEST(Evaluate, NothingMatched) {
  const Recording run = Noisy(testing::Drive, 0.0);
  const Trajectory elsewhen = testing::Sample(testing::Drive, 10.0, 0.1, 0);
  EXPECT_EQ(Evaluate(elsewhen, run.reference).status, EvaluationStatus::kNothingMatched);
  EXPECT_EQ(Evaluate(elsewhen, run.reference, {.calibrate = true}).status, EvaluationStatus::kNothingMatched);
  EXPECT_EQ(Evaluate({}, {}).status, EvaluationStatus::kNothingMatched);
  const Trajectory one = {run.reference[0]};
  const Evaluation single = Evaluate(one, run.reference);
  EXPECT_EQ(single.status, EvaluationStatus::kOk);
  EXPECT_NEAR(single.absolute.translation_m.max, 0.0, 1e-12);
  EXPECT_EQ(Evaluate(one, run.reference, {.calibrate = true}).status, EvaluationStatus::kCalibrationFailed);
}

TEST(EvaluationOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(EvaluationOptions{}.Validate(), "");
  EXPECT_EQ(EvaluationOptions{.association = {.max_gap_us = 0}}.Validate().substr(0, 23), "association.max_gap_us:");
  EXPECT_NE((EvaluationOptions{.alignment = AlignmentKind::kYaw, .calibrate = true}.Validate()), "");
  EXPECT_NE(EvaluationOptions{.rpe_steps_s = {0.0}}.Validate(), "");
  EXPECT_NE(EvaluationOptions{.rpe_steps_m = {std::nan("")}}.Validate(), "");
}

}  // namespace
}  // namespace lcmslam
