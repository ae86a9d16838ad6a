#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lcmslam {

// Statistics of two systems over the same episodes; the episode is the unit. A failed episode is an infinite error: it
// ranks worst and is never left out. No value is NaN. All pure and deterministic.

// Differences a - b, episode by episode; 0 where both failed.
[[nodiscard]] std::vector<double> PairedDifferences(std::span<const double> a, std::span<const double> b);

// Two-sided p of the signed-rank test (Wilcoxon 1945): how likely differences so one-sided are when neither system is
// better. Zeros are left out, equal sizes share their mean rank. Exact given these ranks up to 200 differences, by the
// normal distribution with continuity correction beyond. 1 for no differences. O(n^3) up to 200, else O(n log n).
[[nodiscard]] double WilcoxonSignedRankP(std::span<const double> differences);

// The median of all means of two differences, themselves included (Hodges & Lehmann 1963): by how much a is worse.
// Infinite when failures prevail; NaN for no differences. O(n^2).
[[nodiscard]] double HodgesLehmannShift(std::span<const double> differences);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};
struct BootstrapOptions {
  int resamples = 2000;
  double confidence = 0.95;
  uint64_t seed = 1;
};
// Percentile interval of the Hodges-Lehmann shift over episodes drawn with replacement (Efron 1979). NaN for no
// differences. O(resamples n^2).
[[nodiscard]] Interval BootstrapShiftInterval(std::span<const double> differences,
                                              const BootstrapOptions& options = {});

// p values of several comparisons, adjusted so that the chance of any false claim stays at the level of one (Holm
// 1979), in the order given.
[[nodiscard]] std::vector<double> HolmAdjusted(std::span<const double> p_values);

struct PairedComparison {
  int64_t episodes = 0;
  int64_t wins_a = 0, wins_b = 0, ties = 0;  // a wins where its error is smaller
  double p = 1.0;                            // WilcoxonSignedRankP
  double shift = 0.0;                        // HodgesLehmannShift of a - b: negative when a is better
  Interval shift_interval;

  double win_rate_a() const;  // ties count half; NaN for no episodes
};
// Errors of systems a and b in the same episodes, in the same order and as many.
[[nodiscard]] PairedComparison ComparePaired(std::span<const double> a, std::span<const double> b,
                                             const BootstrapOptions& options = {});

}  // namespace lcmslam
