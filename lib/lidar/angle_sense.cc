#include "lidar/angle_sense.h"

#include <cmath>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

constexpr double kFullTurn_rad = DegToRad(300.0);  // what a turn with a few lost beams still covers

}  // namespace

AngleSense DetectAngleSense(int64_t utime, std::span<const int64_t> beam_utimes, std::span<const float> angles_rad) {
  if (beam_utimes.empty() || beam_utimes.front() != utime || beam_utimes.back() <= utime)
    return AngleSense::kCounterClockwise;
  double turned_rad = 0.0;
  double last_rad = NAN;
  for (const float angle_rad : angles_rad) {
    if (!std::isfinite(angle_rad)) continue;
    if (std::isfinite(last_rad)) turned_rad += WrapAngle(angle_rad - last_rad);
    last_rad = angle_rad;
  }
  return turned_rad > kFullTurn_rad ? AngleSense::kClockwise : AngleSense::kCounterClockwise;
}

}  // namespace lcmslam
