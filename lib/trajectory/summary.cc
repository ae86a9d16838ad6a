#include "trajectory/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lcmslam {
namespace {

// Reorders the values.
double PercentileInPlace(std::span<double> values, double fraction) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), lower, values.end());
  const double weight = rank - std::floor(rank);
  if (weight == 0.0) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + weight * (upper - *lower);
}

}  // namespace

Summary Summarize(std::span<const double> values) {
  Summary s;
  s.count = static_cast<int64_t>(values.size());
  if (values.empty()) return s;
  const double n = static_cast<double>(values.size());
  double sum = 0.0, sum_squares = 0.0;
  for (const double v : values) {
    sum += v;
    sum_squares += v * v;
  }
  s.mean = sum / n;
  s.rmse = std::sqrt(sum_squares / n);
  double sum_deviations = 0.0;
  for (const double v : values) sum_deviations += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(sum_deviations / n);

  std::vector<double> ordered(values.begin(), values.end());
  s.median = PercentileInPlace(ordered, 0.5);
  s.p95 = PercentileInPlace(ordered, 0.95);
  s.p99 = PercentileInPlace(ordered, 0.99);
  const auto [min, max] = std::ranges::minmax(values);
  s.min = min;
  s.max = max;
  return s;
}

double Percentile(std::span<const double> values, double fraction) {
  std::vector<double> ordered(values.begin(), values.end());
  return PercentileInPlace(ordered, fraction);
}

}  // namespace lcmslam
