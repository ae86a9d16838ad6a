#include "trajectory/paired_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// From the definition: all 2^n ways to give the signs.
double WilcoxonByEnumeration(const std::vector<double>& all) {
  std::vector<double> d;
  std::ranges::copy_if(all, std::back_inserter(d), [](double x) { return x != 0.0; });
  const size_t n = d.size();
  std::vector<double> rank(n);
  for (size_t i = 0; i < n; ++i) {
    double smaller = 0, equal = 0;
    for (size_t j = 0; j < n; ++j) {
      smaller += std::abs(d[j]) < std::abs(d[i]);
      equal += std::abs(d[j]) == std::abs(d[i]);
    }
    rank[i] = smaller + 0.5 * (equal + 1);
  }
  const auto sum_of = [&](auto is_positive) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) sum += is_positive(i) ? rank[i] : 0;
    return sum;
  };
  const double observed = sum_of([&](size_t i) { return d[i] > 0; });
  double at_most = 0, at_least = 0;
  for (size_t signs = 0; signs < size_t{1} << n; ++signs) {
    const double w = sum_of([&](size_t i) { return (signs >> i & 1) != 0; });
    at_most += w <= observed;
    at_least += w >= observed;
  }
  return std::min(1.0, 2.0 * std::min(at_most, at_least) / static_cast<double>(size_t{1} << n));
}

TEST(WilcoxonSignedRankP, AgreesWithEnumeration) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed);
    std::vector<double> d(1 + seed % 12);
    for (double& x : d) x = noise.Uniform(-1.0, 2.0);
    EXPECT_NEAR(WilcoxonSignedRankP(d), WilcoxonByEnumeration(d), 1e-12);
    for (double& x : d) x = std::round(3.0 * x);  // ties and zeros
    EXPECT_NEAR(WilcoxonSignedRankP(d), WilcoxonByEnumeration(d), 1e-12);
  }
}

TEST(WilcoxonSignedRankP, KnownCases) {
  const std::vector<double> all_better = {-1, -2, -3, -4, -5, -6};
  EXPECT_DOUBLE_EQ(WilcoxonSignedRankP(all_better), 2.0 / 64.0);
  EXPECT_EQ(WilcoxonSignedRankP({}), 1.0);
  EXPECT_EQ(WilcoxonSignedRankP(std::vector<double>(5, 0.0)), 1.0);
  EXPECT_EQ(WilcoxonSignedRankP(std::vector<double>{3.0}), 1.0);
}

// Where exact and normal meet they agree, and false alarms come as often as they should.
TEST(WilcoxonSignedRankP, LargeSamples) {
  testing::Noise noise(4);
  std::vector<double> d(200);
  for (double& x : d) x = noise.Gauss(1.0) + 0.15;
  const double exact = WilcoxonSignedRankP(d);
  d.push_back(1e-9);  // the smallest rank: hardly a difference
  EXPECT_NEAR(WilcoxonSignedRankP(d), exact, 0.01 * exact + 1e-3);
  int alarms = 0;
  for (int k = 0; k < 1000; ++k) {
    std::vector<double> none(30);
    for (double& x : none) x = noise.Gauss(1.0);
    alarms += WilcoxonSignedRankP(none) < 0.05;
  }
  EXPECT_NEAR(alarms, 50, 25);
}

TEST(WilcoxonSignedRankP, FailuresRankWorst) {
  const std::vector<double> one_failure = {-1, -2, -3, -4, -5, kInfinity};
  EXPECT_NEAR(WilcoxonSignedRankP(one_failure), WilcoxonByEnumeration({-1, -2, -3, -4, -5, 100}), 1e-12);
}

TEST(HodgesLehmannShift, IsTheMedianOfAllMeansOfTwo) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    testing::Noise noise(seed);
    std::vector<double> d(1 + seed), means;
    for (double& x : d) x = noise.Uniform(-1.0, 2.0);
    for (size_t i = 0; i < d.size(); ++i) {
      for (size_t j = 0; j <= i; ++j) means.push_back((d[i] + d[j]) / 2);
    }
    std::ranges::sort(means);
    const size_t n = means.size();
    EXPECT_NEAR(HodgesLehmannShift(d), (means[(n - 1) / 2] + means[n / 2]) / 2, 1e-12);
  }
  EXPECT_TRUE(std::isnan(HodgesLehmannShift({})));
}

TEST(HodgesLehmannShift, BearsFailures) {
  EXPECT_EQ(HodgesLehmannShift(std::vector<double>{1, 1, 1, 1, 1, 1, kInfinity}), 1.0);
  EXPECT_EQ(HodgesLehmannShift(std::vector<double>{kInfinity, -kInfinity}), 0.0);
  EXPECT_EQ(HodgesLehmannShift(std::vector<double>{kInfinity, kInfinity, 0.0}), kInfinity);
}

// Of many samples about 95 % of the intervals hold the true shift.
TEST(BootstrapShiftInterval, CoversTheTruth) {
  testing::Noise noise(9);
  int covered = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<double> d(40);
    for (double& x : d) x = 0.5 + noise.Gauss(1.0);
    const Interval i = BootstrapShiftInterval(d, {.resamples = 300, .seed = static_cast<uint64_t>(k)});
    covered += i.low <= 0.5 && 0.5 <= i.high;
  }
  EXPECT_NEAR(covered, 190, 14);
}

TEST(BootstrapShiftInterval, SameSeedSameInterval) {
  const std::vector<double> d = {0.1, -0.3, 0.5, 0.2, kInfinity};
  const Interval a = BootstrapShiftInterval(d, {.seed = 3}), b = BootstrapShiftInterval(d, {.seed = 3});
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_LE(a.low, HodgesLehmannShift(d));
  EXPECT_TRUE(std::isnan(BootstrapShiftInterval({}).low));
}

TEST(HolmAdjusted, StepsDown) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.005};
  EXPECT_THAT(HolmAdjusted(p), ElementsAre(DoubleNear(0.03, 1e-15), DoubleNear(0.06, 1e-15), DoubleNear(0.06, 1e-15),
                                           DoubleNear(0.02, 1e-15)));
  EXPECT_THAT(HolmAdjusted(std::vector<double>{0.7, 0.9}), ElementsAre(1.0, 1.0));
  EXPECT_TRUE(HolmAdjusted({}).empty());
}

TEST(ComparePaired, CountsWinsAndShift) {
  const std::vector<double> a = {1.0, 2.0, 3.0, 4.0, kInfinity, kInfinity}, b = {2.0, 3.0, 3.0, 5.0, 6.0, kInfinity};
  const PairedComparison c = ComparePaired(a, b);
  EXPECT_EQ(c.episodes, 6);
  EXPECT_EQ(c.wins_a, 3);
  EXPECT_EQ(c.wins_b, 1);
  EXPECT_EQ(c.ties, 2) << "one equal, one where both failed";
  EXPECT_DOUBLE_EQ(c.win_rate_a(), 4.0 / 6.0);
  EXPECT_EQ(c.shift, -0.5);
  EXPECT_TRUE(std::isnan(ComparePaired({}, {}).win_rate_a()));
}

}  // namespace
}  // namespace lcmslam
