#include "trajectory/paired_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <boost/math/distributions/normal.hpp>

#include "trajectory/summary.h"

namespace lcmslam {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Twice the rank of each size, so that mean ranks of ties are whole.
std::vector<int64_t> DoubledRanks(const std::vector<double>& sizes) {
  std::vector<size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return sizes[i]; });
  std::vector<int64_t> ranks(sizes.size());
  for (size_t begin = 0; begin < order.size();) {
    size_t end = begin;
    while (end < order.size() && sizes[order[end]] == sizes[order[begin]]) ++end;
    for (size_t k = begin; k < end; ++k) ranks[order[k]] = static_cast<int64_t>(begin + 1 + end);
    begin = end;
  }
  return ranks;
}

// P(sum of a random half of the ranks <= w), each rank taken with probability 1/2, from the distribution of all sums.
double ExactTail(const std::vector<int64_t>& ranks, int64_t w) {
  const int64_t total = std::accumulate(ranks.begin(), ranks.end(), int64_t{0});
  std::vector<double> probability(static_cast<size_t>(total) + 1, 0.0);
  probability[0] = 1.0;
  int64_t reached = 0;
  for (const int64_t rank : ranks) {
    for (int64_t sum = reached; sum >= 0; --sum) {
      const double half = 0.5 * probability[static_cast<size_t>(sum)];
      probability[static_cast<size_t>(sum)] = half;
      probability[static_cast<size_t>(sum + rank)] += half;
    }
    reached += rank;
  }
  return std::accumulate(probability.begin(), probability.begin() + w + 1, 0.0);
}

// The same for many ranks; `step` is the distance between possible sums.
double NormalTail(const std::vector<int64_t>& ranks, int64_t w, double step) {
  double mean = 0.0, variance = 0.0;
  for (const int64_t rank : ranks) {
    mean += 0.5 * static_cast<double>(rank);
    variance += 0.25 * static_cast<double>(rank) * static_cast<double>(rank);
  }
  const boost::math::normal normal(mean, std::sqrt(variance));
  return boost::math::cdf(normal, static_cast<double>(w) + 0.5 * step);
}

// Infinite differences of both signs say nothing together.
double MeanOfTwo(double x, double y) { return std::isinf(x) && x == -y ? 0.0 : 0.5 * (x + y); }

double MedianInPlace(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return MeanOfTwo(*std::max_element(values.begin(), middle), *middle);
}

// `walsh` is working memory.
double ShiftOf(std::span<const double> differences, std::vector<double>& walsh) {
  walsh.clear();
  for (size_t i = 0; i < differences.size(); ++i) {
    for (size_t j = i; j < differences.size(); ++j) walsh.push_back(MeanOfTwo(differences[i], differences[j]));
  }
  return walsh.empty() ? kNaN : MedianInPlace(walsh);
}

// The k-th of sorted values, by Percentile's rule without its arithmetic on infinities.
double SortedPercentile(const std::vector<double>& sorted, double fraction) {
  return sorted[static_cast<size_t>(std::lround(fraction * static_cast<double>(sorted.size() - 1)))];
}

}  // namespace

std::vector<double> PairedDifferences(std::span<const double> a, std::span<const double> b) {
  std::vector<double> differences;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) differences.push_back(a[i] == b[i] ? 0.0 : a[i] - b[i]);
  return differences;
}

double WilcoxonSignedRankP(std::span<const double> differences) {
  constexpr size_t kExactUpTo = 200;
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double d : differences) {
    if (d == 0.0) continue;
    sizes.push_back(std::abs(d));
    positive.push_back(d > 0.0);
  }
  if (sizes.empty()) return 1.0;
  const std::vector<int64_t> ranks = DoubledRanks(sizes);
  int64_t sum_positive = 0, total = 0;
  for (size_t i = 0; i < ranks.size(); ++i) {
    total += ranks[i];
    if (positive[i]) sum_positive += ranks[i];
  }
  const int64_t smaller = std::min(sum_positive, total - sum_positive);
  const double tail = ranks.size() <= kExactUpTo ? ExactTail(ranks, smaller) : NormalTail(ranks, smaller, 2.0);
  return std::min(1.0, 2.0 * tail);
}

double HodgesLehmannShift(std::span<const double> differences) {
  std::vector<double> walsh;
  return ShiftOf(differences, walsh);
}

Interval BootstrapShiftInterval(std::span<const double> differences, const BootstrapOptions& options) {
  if (differences.empty() || options.resamples < 1) return {kNaN, kNaN};
  std::mt19937_64 random(options.seed);
  const uint64_t n = differences.size();
  std::vector<double> drawn(n), walsh, shifts;
  for (int k = 0; k < options.resamples; ++k) {
    for (double& d : drawn) d = differences[((random() >> 32) * n) >> 32];
    shifts.push_back(ShiftOf(drawn, walsh));
  }
  std::ranges::sort(shifts);
  const double tail = 0.5 * (1.0 - options.confidence);
  return {SortedPercentile(shifts, tail), SortedPercentile(shifts, 1.0 - tail)};
}

std::vector<double> HolmAdjusted(std::span<const double> p_values) {
  std::vector<size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (size_t k = 0; k < order.size(); ++k) {
    const auto still_open = static_cast<double>(order.size() - k);
    largest = std::max(largest, std::min(1.0, still_open * p_values[order[k]]));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

double PairedComparison::win_rate_a() const {
  if (episodes == 0) return kNaN;
  return (static_cast<double>(wins_a) + 0.5 * static_cast<double>(ties)) / static_cast<double>(episodes);
}

PairedComparison ComparePaired(std::span<const double> a, std::span<const double> b, const BootstrapOptions& options) {
  const std::vector<double> differences = PairedDifferences(a, b);
  PairedComparison result;
  result.episodes = static_cast<int64_t>(differences.size());
  result.wins_a = std::ranges::count_if(differences, [](double d) { return d < 0.0; });
  result.wins_b = std::ranges::count_if(differences, [](double d) { return d > 0.0; });
  result.ties = result.episodes - result.wins_a - result.wins_b;
  result.p = WilcoxonSignedRankP(differences);
  result.shift = HodgesLehmannShift(differences);
  result.shift_interval = BootstrapShiftInterval(differences, options);
  return result;
}

}  // namespace lcmslam
