#include "trajectory/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lcmslam {
namespace {

// Reorders the values. Saves time where an earlier call for the fraction `known` has brought the smaller ones forward.
double PercentileInPlace(std::span<double> values, double fraction, double known = 0.0) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank_of = [&](double f) { return f * static_cast<double>(values.size() - 1); };
  const auto at = [&](double rank) { return values.begin() + static_cast<std::ptrdiff_t>(rank); };
  const double rank = rank_of(fraction);
  const auto lower = at(rank);
  std::nth_element(at(rank_of(known)), lower, values.end());
  const double weight = rank - std::floor(rank);
  if (weight == 0.0) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + weight * (upper - *lower);
}

}  // namespace

Summary Summarize(std::vector<double> values) {
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

  const auto [min, max] = std::ranges::minmax(values);
  s.min = min;
  s.max = max;
  s.median = PercentileInPlace(values, 0.5);
  s.p95 = PercentileInPlace(values, 0.95, 0.5);
  s.p99 = PercentileInPlace(values, 0.99, 0.95);
  return s;
}

double Percentile(std::span<const double> values, double fraction) {
  std::vector<double> ordered(values.begin(), values.end());
  return PercentileInPlace(ordered, fraction);
}

}  // namespace lcmslam
