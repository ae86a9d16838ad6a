#include "evaluator/report/numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/angles.h"

namespace lcmslam::report {

std::string Number(double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return "failed";
  const int magnitude = value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fmt::format("{:.{}f}", value, std::clamp(2 - magnitude, 0, 4));
}

std::string Shift(double value) {
  if (std::isinf(value)) return value > 0 ? "+\u221e" : "-\u221e";
  return Number(value);
}

std::string Millimetres(double value_m) { return Number(1e3 * value_m); }
std::string Milliradians(double value_rad) { return Number(1e3 * value_rad); }
std::string Degrees(double value_rad) { return Number(RadToDeg(value_rad)); }
std::string Percent(double share) { return std::isnan(share) ? "-" : fmt::format("{:.1f}", 100.0 * share); }
std::string PValue(double p) { return p >= 0.001 ? fmt::format("{:.3f}", p) : fmt::format("{:.1e}", p); }

}  // namespace lcmslam::report
