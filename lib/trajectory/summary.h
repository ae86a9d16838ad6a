#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lcmslam {

// What is said of a set of errors, in the unit of the errors. NaN where nothing was measured (count 0).
struct Summary {
  int64_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double rmse = std::numeric_limits<double>::quiet_NaN();    // root of the mean square
  double median = std::numeric_limits<double>::quiet_NaN();  // mean of the middle two when the count is even
  double sd = std::numeric_limits<double>::quiet_NaN();      // divides by count, as evo and NumPy do
  double p95 = std::numeric_limits<double>::quiet_NaN();     // as Percentile
  double p99 = std::numeric_limits<double>::quiet_NaN();
  double min = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

// Values must be finite. O(n).
[[nodiscard]] Summary Summarize(std::vector<double> values);

// The value below which `fraction` (0 to 1) of the values lie, linear between order statistics (Hyndman & Fan 1996,
// type 7, the default of NumPy and R). NaN for no values. O(n).
[[nodiscard]] double Percentile(std::span<const double> values, double fraction);

}  // namespace lcmslam
