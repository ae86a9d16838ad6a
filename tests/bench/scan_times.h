#pragma once

#include <algorithm>
#include <ctime>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace lcmslam {

// The processor time of every scan of a drive: its best over all iterations, so that other work on the machine does not
// count.
class ScanTimes {
 public:
  explicit ScanTimes(size_t scans) : best_ms_(scans, std::numeric_limits<double>::infinity()) {}

  // Runs and times `process` on the i-th scan.
  template <typename Process>
  auto Measure(size_t i, Process&& process) {
    const std::clock_t start = std::clock();
    auto result = std::forward<Process>(process)();
    const double elapsed_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best_ms_[i] = std::min(best_ms_[i], elapsed_ms);
    return result;
  }

  double Quantile(double q) const {
    std::vector<double> values = best_ms_;
    const auto nth = values.begin() + static_cast<ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  }

  // Counters PREFIXmedian_ms, PREFIXp95_ms, PREFIXp99_ms.
  void Report(benchmark::State& state, const std::string& prefix = "") const {
    state.counters[prefix + "median_ms"] = Quantile(0.5);
    state.counters[prefix + "p95_ms"] = Quantile(0.95);
    state.counters[prefix + "p99_ms"] = Quantile(0.99);
  }

 private:
  std::vector<double> best_ms_;
};

}  // namespace lcmslam
