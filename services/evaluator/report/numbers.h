#pragma once

#include <string>

namespace lcmslam::report {

// Three significant digits, at most four decimals; "failed" for infinity, "-" for NaN.
std::string Number(double value);
std::string Millimetres(double value_m);
// A difference of errors: infinite ones with sign, as where failures prevail.
std::string Shift(double value);
std::string Milliradians(double value_rad);
std::string Degrees(double value_rad);
std::string Percent(double share);
// "0.032", or "3.1e-08" where it is small.
std::string PValue(double p);

}  // namespace lcmslam::report
