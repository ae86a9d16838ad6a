#include "trajectory/association.h"

#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

// One binary search a pose, which InterpolateAt's own test covers.
TEST(Associate, AgreesWithSearchForEachPose) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed);
    const auto random_stamps = [&](size_t count, double mean_step_us) {
      Trajectory t;
      auto utime = static_cast<int64_t>(noise.Uniform(-2e6, 2e6));
      for (size_t k = 0; k < count; ++k) {
        utime += 1 + static_cast<int64_t>(noise.Uniform(0, 2 * mean_step_us));
        t.push_back({utime, testing::Flight(static_cast<double>(utime) * 1e-6)});
      }
      return t;
    };
    const Trajectory estimate = random_stamps(200, 1e5);
    Trajectory reference = random_stamps(300, 5e4);
    reference.erase(reference.begin() + 100, reference.begin() + 120);
    const AssociationOptions options{.max_gap_us = 90'000, .time_offset_us = 7'000};
    const Association a = Associate(estimate, reference, options);
    size_t matched = 0;
    for (const StampedPose& e : estimate) {
      const auto expected = InterpolateAt(reference, e.utime + options.time_offset_us, options.max_gap_us);
      if (!expected) continue;
      ASSERT_LT(matched, a.pairs.size());
      EXPECT_EQ(a.pairs[matched].utime, e.utime);
      EXPECT_EQ(a.pairs[matched].estimate.translation, e.pose.translation);
      EXPECT_LT((a.pairs[matched].reference.translation - expected->translation).norm(), 1e-12);
      EXPECT_LT(AngleBetween(a.pairs[matched].reference.rotation, expected->rotation), 1e-7);
      ++matched;
    }
    EXPECT_EQ(matched, a.pairs.size());
    EXPECT_EQ(matched + static_cast<size_t>(a.unmatched()), estimate.size());
    EXPECT_NEAR(a.coverage(), static_cast<double>(matched) / static_cast<double>(estimate.size()), 1e-15);
  }
}

TEST(Associate, SaysWhyPosesHaveNoPartner) {
  const Trajectory reference = {{1'000, {}}, {2'000, {}}, {900'000, {}}, {901'000, {}}};
  const Trajectory estimate = {{500, {}}, {1'000, {}}, {1'500, {}}, {400'000, {}}, {901'000, {}}, {901'001, {}}};
  const Association a = Associate(estimate, reference, {.max_gap_us = 2'000});
  EXPECT_EQ(a.before, 1);
  EXPECT_EQ(a.in_gap, 1);
  EXPECT_EQ(a.after, 1);
  EXPECT_EQ(a.pairs.size(), 3u);
  EXPECT_DOUBLE_EQ(a.coverage(), 0.5);
}

TEST(Associate, EmptySides) {
  const Trajectory one = {{1'000, {}}};
  EXPECT_EQ(Associate({}, one).coverage(), 0.0);
  EXPECT_EQ(Associate(one, {}).coverage(), 0.0);
  EXPECT_EQ(Associate(one, {}).unmatched(), 1);
  EXPECT_EQ(Associate(one, one).coverage(), 1.0) << "one pose on each side at the same moment";
}

TEST(IsPlanar, LevelPosesAtOneHeight) {
  EXPECT_TRUE(IsPlanar(testing::Sample(testing::Drive, 10.0, 0.1)));
  EXPECT_FALSE(IsPlanar(testing::Sample(testing::Flight, 10.0, 0.1)));
  EXPECT_TRUE(IsPlanar({}));
  const Trajectory tilted = {{0, {{}, testing::RotationVector({0.1, 0.0, 0.0})}}};
  EXPECT_FALSE(IsPlanar(tilted));
}

}  // namespace
}  // namespace lcmslam
