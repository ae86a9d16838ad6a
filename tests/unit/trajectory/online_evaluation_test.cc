#include "trajectory/online_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::HasSubstr;

constexpr int64_t kStart = 1'000'000'000;

Trajectory NoisyEstimate(double duration_s, uint64_t seed) {
  testing::Noise noise(seed);
  return testing::Sample(
      [&](double t_s) {
        return testing::Drive(t_s) * ToPose3({noise.Gauss(0.01), noise.Gauss(0.01), noise.Gauss(0.01)});
      },
      duration_s, 0.1, kStart);
}

Trajectory Reference(double duration_s, int64_t start_utime = kStart) {
  return testing::Sample(testing::Drive, duration_s, 0.02, start_utime);
}

void ExpectSame(const OnlineEvaluation& online, const Evaluation& batch) {
  EXPECT_EQ(online.association().pairs.size(), batch.association.pairs.size());
  EXPECT_EQ(online.association().before, batch.association.before);
  EXPECT_EQ(online.association().in_gap, batch.association.in_gap);
  const OnlineEvaluation::Result result = online.ErrorSoFar();
  EXPECT_DOUBLE_EQ(result.error.translation_m.mean, batch.absolute.translation_m.mean);
  EXPECT_DOUBLE_EQ(result.error.translation_m.max, batch.absolute.translation_m.max);
  EXPECT_DOUBLE_EQ(result.error.rotation_rad.rmse, batch.absolute.rotation_rad.rmse);
  EXPECT_DOUBLE_EQ(result.latest_error_m, batch.absolute_errors.translation_m.back());
  EXPECT_EQ(result.alignment.kind, batch.alignment.kind);
}

// However the two streams are interleaved, the end is that of the batch evaluation.
TEST(OnlineEvaluation, AgreesWithBatchInAnyInterleaving) {
  const Trajectory estimate = NoisyEstimate(30.0, 1);
  Trajectory reference = Reference(40.0, kStart + 1'010'000);         // starts late
  reference.erase(reference.begin() + 500, reference.begin() + 600);  // 2 s missing
  const Evaluation batch = Evaluate(estimate, reference);
  for (uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed);
    OnlineEvaluation online({});
    size_t e = 0, r = 0;
    while (e < estimate.size() || r < reference.size()) {
      const bool take_estimate = r == reference.size() || (e < estimate.size() && noise.Uniform(0, 1) < 0.2);
      if (take_estimate) online.AddEstimate(estimate[e++]);
      if (!take_estimate) online.AddReference(reference[r++]);
    }
    ExpectSame(online, batch);
  }
  EXPECT_GT(batch.association.before, 5);
  EXPECT_GT(batch.association.in_gap, 15);
}

TEST(OnlineEvaluation, SaysWhatIsMissing) {
  OnlineEvaluation online({});
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("no estimate yet; no reference yet"));
  for (const StampedPose& p : NoisyEstimate(5.0, 1)) online.AddEstimate(p);
  EXPECT_EQ(online.ErrorSoFar().error.translation_m.count, 0);
  for (const StampedPose& p : Reference(2.0, kStart + 1'000'000)) online.AddReference(p);
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("no reference for 2.0 s"));
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("10 poses before the reference began"));
  for (const StampedPose& p : Reference(1.0, kStart + 4'500'000)) online.AddReference(p);
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("poses in gaps of the reference"));
}

TEST(OnlineEvaluation, ClockThatStepsBackStartsANewSegment) {
  const Trajectory estimate = NoisyEstimate(20.0, 2), reference = Reference(20.0);
  for (const bool reference_steps_first : {true, false}) {
    SCOPED_TRACE(reference_steps_first);
    OnlineEvaluation online({});
    const auto play = [&](size_t estimates) {
      size_t e = 0;
      for (const StampedPose& r : reference) {
        if (reference_steps_first) online.AddReference(r);
        while (e < estimates && estimate[e].utime <= r.utime) online.AddEstimate(estimate[e++]);
        if (!reference_steps_first) online.AddReference(r);
      }
    };
    play(150);
    const double error_m = online.ErrorSoFar().error.translation_m.mean;
    EXPECT_EQ(online.association().pairs.size(), 150u);
    play(150);
    EXPECT_NEAR(static_cast<double>(online.association().pairs.size()), 150.0, 2.0);
    EXPECT_NEAR(online.ErrorSoFar().error.translation_m.mean, error_m, 1e-3);
    EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("clock stepped back"));
    EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("segment 2"));
  }
}

TEST(OnlineEvaluation, RepeatedAndSwappedStampsAreLeftOut) {
  OnlineEvaluation online({});
  const Trajectory estimate = NoisyEstimate(5.0, 3), reference = Reference(6.0);
  for (const StampedPose& p : reference) {
    online.AddReference(p);
    online.AddReference(p);
  }
  for (size_t i = 0; i < estimate.size(); ++i) {
    online.AddEstimate(estimate[i]);
    if (i > 0) online.AddEstimate(estimate[i - 1]);
  }
  ExpectSame(online, Evaluate(estimate, reference));
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("351 poses out of order left out"));
}

}  // namespace
}  // namespace lcmslam
