#include "trajectory/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

// From the definition, on sorted values.
double SortedPercentile(std::vector<double> v, double fraction) {
  std::ranges::sort(v);
  const double rank = fraction * static_cast<double>(v.size() - 1);
  const auto k = static_cast<size_t>(rank);
  return k + 1 == v.size() ? v[k] : v[k] + (rank - static_cast<double>(k)) * (v[k + 1] - v[k]);
}

TEST(Summarize, AgreesWithDefinitions) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed);
    std::vector<double> v(1 + static_cast<size_t>(noise.Uniform(0, 300)));
    for (double& x : v) x = noise.Uniform(-1.0, 3.0);
    const double n = static_cast<double>(v.size());
    double mean = 0.0, square = 0.0, variance = 0.0;
    for (const double x : v) mean += x / n;
    for (const double x : v) square += x * x / n;
    for (const double x : v) variance += (x - mean) * (x - mean) / n;
    const Summary s = Summarize(v);
    EXPECT_EQ(s.count, static_cast<int64_t>(v.size()));
    EXPECT_NEAR(s.mean, mean, 1e-12);
    EXPECT_NEAR(s.rmse, std::sqrt(square), 1e-12);
    EXPECT_NEAR(s.sd, std::sqrt(variance), 1e-12);
    EXPECT_NEAR(s.median, SortedPercentile(v, 0.5), 1e-12);
    EXPECT_NEAR(s.p95, SortedPercentile(v, 0.95), 1e-12);
    EXPECT_NEAR(s.p99, SortedPercentile(v, 0.99), 1e-12);
    EXPECT_EQ(s.min, *std::ranges::min_element(v));
    EXPECT_EQ(s.max, *std::ranges::max_element(v));
  }
}

TEST(Summarize, NothingMeasuredIsNotZero) {
  const Summary s = Summarize({});
  EXPECT_EQ(s.count, 0);
  EXPECT_TRUE(std::isnan(s.mean));
  EXPECT_TRUE(std::isnan(s.max));
  EXPECT_TRUE(std::isnan(Percentile({}, 0.5)));
}

TEST(Summarize, OneValue) {
  const std::vector<double> one = {0.25};
  const Summary s = Summarize(one);
  EXPECT_EQ(s.mean, 0.25);
  EXPECT_EQ(s.median, 0.25);
  EXPECT_EQ(s.p95, 0.25);
  EXPECT_EQ(s.sd, 0.0);
}

}  // namespace
}  // namespace lcmslam
