#include "trajectory/online_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

// The association and evaluation at the end.
void ExpectSameFinal(OnlineEvaluation& online, const Evaluation& batch) {
  const Association association = online.FinalAssociation(online.TakePairs());
  EXPECT_EQ(association.before, batch.association.before);
  EXPECT_EQ(association.in_gap, batch.association.in_gap);
  EXPECT_EQ(association.after, batch.association.after);
  const Evaluation evaluation = EvaluatePairs(association, online.alignment_kind(), {});
  EXPECT_DOUBLE_EQ(evaluation.absolute.translation_m.rmse, batch.absolute.translation_m.rmse);
}

void ExpectSame(OnlineEvaluation& online, const Evaluation& batch) {
  const OnlineEvaluation::Result result = online.ErrorSoFar();
  EXPECT_EQ(static_cast<size_t>(result.matched), batch.association.pairs.size());
  EXPECT_EQ(result.unmatched, batch.association.before + batch.association.in_gap);
  EXPECT_NEAR(result.error.translation_m.mean, batch.absolute.translation_m.mean, 1e-9);
  EXPECT_NEAR(result.error.translation_m.max, batch.absolute.translation_m.max, 1e-9);
  EXPECT_NEAR(result.error.rotation_rad.rmse, batch.absolute.rotation_rad.rmse, 1e-9);
  EXPECT_NEAR(result.latest_error_m, batch.absolute_errors.translation_m.back(), 1e-9);
  EXPECT_EQ(result.alignment.kind, batch.alignment.kind);
  ExpectSameFinal(online, batch);
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
    EXPECT_EQ(online.ErrorSoFar().matched, 150);
    play(150);
    EXPECT_NEAR(static_cast<double>(online.ErrorSoFar().matched), 150.0, 2.0);
    EXPECT_EQ(static_cast<int64_t>(online.TakePairs().size()), online.ErrorSoFar().matched) << "of the new segment";
    EXPECT_EQ(online.segment(), 2);
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

// Both streams by time, as they would come in.
void Play(const Trajectory& estimate, const Trajectory& reference, OnlineEvaluation& online) {
  size_t e = 0;
  for (const StampedPose& r : reference) {
    while (e < estimate.size() && estimate[e].utime <= r.utime) online.AddEstimate(estimate[e++]);
    online.AddReference(r);
  }
}

void Delay(std::span<StampedPose> poses, int64_t step_us) {
  for (StampedPose& p : poses) p.utime += step_us;
}

// The poses are the same before and after: so is the error.
TEST(OnlineEvaluation, ClockOfBothThatStepsAheadIsSaidAndTheErrorGoesOn) {
  Trajectory estimate = NoisyEstimate(20.0, 2), reference = Reference(20.0);
  OnlineEvaluation undisturbed({});
  Play(estimate, reference, undisturbed);
  Delay(std::span(estimate).subspan(100), 100'000'000);
  Delay(std::span(reference).subspan(500), 100'000'000);
  OnlineEvaluation online({});
  Play(estimate, reference, online);
  const OnlineEvaluation::Result result = online.ErrorSoFar();
  EXPECT_THAT(result.text, HasSubstr("clock stepped ahead 100."));
  EXPECT_EQ(online.segment(), 1);
  EXPECT_EQ(result.matched, undisturbed.ErrorSoFar().matched);
  EXPECT_NEAR(result.error.translation_m.mean, undisturbed.ErrorSoFar().error.translation_m.mean, 1e-9);
}

TEST(OnlineEvaluation, ClockOfOneThatStepsAheadIsSaid) {
  Trajectory estimate = NoisyEstimate(20.0, 2);
  Delay(std::span(estimate).subspan(100), 100'000'000);
  OnlineEvaluation online({});
  const Trajectory reference = Reference(20.0);
  size_t e = 0;
  for (const StampedPose& r : reference) {
    online.AddReference(r);
    if (r.utime >= kStart + static_cast<int64_t>(e) * 100'000) online.AddEstimate(estimate[e++]);
  }
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("clock stepped ahead 100.0"));
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("no reference for 100.0 s"));
  EXPECT_EQ(online.ErrorSoFar().matched, 100);
}

TEST(OnlineEvaluation, SingleStampsFromTheFutureAreLeftOut) {
  for (const bool in_reference : {true, false}) {
    SCOPED_TRACE(in_reference);
    const Trajectory estimate = NoisyEstimate(20.0, 2), reference = Reference(20.0);
    const Evaluation batch = Evaluate(estimate, reference);
    OnlineEvaluation online({});
    size_t e = 0;
    for (size_t i = 0; i < reference.size(); ++i) {
      if (in_reference && i == 500) online.AddReference({kStart + 3'600'000'000, {}});
      if (!in_reference && i == 500) online.AddEstimate({kStart + 3'600'000'000, {}});
      online.AddReference(reference[i]);
      while (e < estimate.size() && estimate[e].utime <= reference[i].utime) online.AddEstimate(estimate[e++]);
    }
    EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("clock stepped ahead 3590."));
    EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("1 pose out of order left out"));
    EXPECT_EQ(online.segment(), 1);
    ExpectSame(online, batch);
  }
}

TEST(OnlineEvaluation, GapsAreNoStepOfTheClock) {
  const Trajectory estimate = NoisyEstimate(20.0, 2);
  Trajectory reference = Reference(20.0);
  reference.erase(reference.begin() + 400, reference.begin() + 600);  // 4 s missing
  OnlineEvaluation online({});
  Play(estimate, reference, online);
  EXPECT_THAT(online.ErrorSoFar().text, Not(HasSubstr("clock")));
  EXPECT_THAT(online.ErrorSoFar().text, HasSubstr("in gaps of the reference"));
}

// 20000 pairs, of which a tenth are kept.
TEST(OnlineEvaluation, LongRunsAreThinnedAndTheLargestErrorIsKept) {
  Trajectory estimate = NoisyEstimate(2000.0, 4);
  const Trajectory reference = Reference(2000.0);
  estimate[7777].pose.translation.y() += 3.0;
  OnlineEvaluation online({});
  Play(estimate, reference, online);
  const Evaluation batch = Evaluate(estimate, reference);
  const OnlineEvaluation::Result result = online.ErrorSoFar();
  EXPECT_LE(result.error.translation_m.count, 2048);
  EXPECT_GE(result.error.translation_m.count, 1024);
  EXPECT_THAT(result.text, HasSubstr("mean over one pose in 16"));
  EXPECT_EQ(online.Describe(), "") << "nothing went wrong";
  EXPECT_EQ(static_cast<size_t>(result.matched), batch.association.pairs.size());
  EXPECT_NEAR(result.error.translation_m.mean / batch.absolute.translation_m.mean, 1.0, 0.05);
  EXPECT_NEAR(result.error.translation_m.max, batch.absolute.translation_m.max, 1e-9);
  EXPECT_LT(AngleBetween(result.alignment.T_world_map.rotation, batch.alignment.T_world_map.rotation), 1e-9);
  ExpectSameFinal(online, batch);
}

}  // namespace
}  // namespace lcmslam
