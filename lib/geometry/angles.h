#pragma once

#include <cmath>
#include <numbers>

namespace lcmslam {

// The same angle in [-pi, pi]. Non-finite in, non-finite out.
inline double WrapAngle(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

constexpr double DegToRad(double deg) { return deg * std::numbers::pi / 180.0; }
constexpr double RadToDeg(double rad) { return rad * 180.0 / std::numbers::pi; }

}  // namespace lcmslam
