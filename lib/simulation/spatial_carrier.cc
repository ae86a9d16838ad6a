#include "simulation/spatial_carrier.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/random/uniform_real_distribution.hpp>

#include "simulation/random.h"
#include "simulation/spatial_way.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr double kKnotInterval_s = 0.75;
constexpr double kMinSpeedShare = 0.65;
constexpr int kKnotsPerCommand = 2;  // a wanted turn rate or tilt holds for 1.5 s
// Of the turn rate. With |tilt| <= kMaxTilt_rad, |w|^2 <= yaw'^2 + pitch'^2 + roll'^2 + 2 |yaw' roll' sin(pitch)| keeps
// the limit.
constexpr double kYawShare = 0.8;
constexpr double kTiltShare = 0.3;
constexpr double kMaxTilt_rad = 0.6;

double Uniform(double low, double high, Rng& rng) {
  return boost::random::uniform_real_distribution<double>(low, high)(rng);
}

// Moves towards a wanted value by a limited step, and draws a new one from +-limit every few knots.
class Command {
 public:
  Command(double limit, double max_step) : limit_(limit), max_step_(max_step) {}

  double value() const { return value_; }
  double Wander(int knot, Rng& rng) {
    if (knot % kKnotsPerCommand == 0) wanted_ = Uniform(-limit_, limit_, rng);
    return Approach(wanted_);
  }
  double Approach(double wanted) {
    value_ += std::clamp(std::clamp(wanted, -limit_, limit_) - value_, -max_step_, max_step_);
    return value_;
  }

 private:
  double limit_;
  double max_step_;
  double wanted_ = 0.0;
  double value_ = 0.0;
};

// Control points of the position; the first `num_at_rest` are the same. Empty where the way is blocked.
std::vector<Vector3d> Positions(const SpatialWorld& world, size_t count, size_t num_at_rest,
                                const SpatialCarrierOptions& options, Rng& rng) {
  const double largest_step_m = options.max_speed_mps * kKnotInterval_s;
  // The spline cuts the corners of the way by less than half a step.
  SpatialWay way(world, {options.min_height_m, options.max_height_m, options.clearance_m + 0.5 * largest_step_m}, rng);
  std::vector<Vector3d> positions(num_at_rest, way.position());
  while (positions.size() < count) {
    positions.push_back(way.position());
    way.Advance(Uniform(kMinSpeedShare, 1.0, rng) * largest_step_m);
  }
  return way.blocked() ? std::vector<Vector3d>() : positions;
}

struct Tilt {
  double pitch_rad;
  double roll_rad;
};

// The tilt with which a multicopter's thrust accelerates it.
Tilt ThrustTilt(const Vector3d& acceleration_mps2, double yaw_rad) {
  const double forward = std::cos(yaw_rad) * acceleration_mps2.x() + std::sin(yaw_rad) * acceleration_mps2.y();
  const double left = -std::sin(yaw_rad) * acceleration_mps2.x() + std::cos(yaw_rad) * acceleration_mps2.y();
  return {.pitch_rad = std::atan2(forward, kGravity_mps2), .roll_rad = -std::atan2(left, kGravity_mps2)};
}

}  // namespace

std::string SpatialCarrierOptions::Validate() const {
  if (!(max_speed_mps > 0.0 && max_speed_mps <= 100.0)) return "max_speed_mps: must be in (0, 100]";
  if (!(max_turn_rate_radps > 0.0 && max_turn_rate_radps <= 100.0)) return "max_turn_rate_radps: must be in (0, 100]";
  if (!(max_tilt_rad >= 0.0 && max_tilt_rad <= kMaxTilt_rad)) return "max_tilt_rad: must be in 0..0.6";
  if (!(std::abs(min_height_m) <= 100.0)) return "min_height_m: must be in -100..100";
  if (!(max_height_m >= min_height_m && max_height_m <= 100.0)) return "max_height_m: must be in min_height_m..100";
  if (!(clearance_m > 0.0 && clearance_m <= 10.0)) return "clearance_m: must be in (0, 10]";
  if (!(rest_s >= 0.0 && rest_s <= 1e5)) return "rest_s: must be in 0..1e5";
  return "";
}

std::optional<SpatialMotion> CarryAround(const SpatialWorld& world, double duration_s,
                                         const SpatialCarrierOptions& options, uint64_t seed) {
  const size_t num_at_rest =
      options.start_in_motion ? 0 : static_cast<size_t>(std::ceil(options.rest_s / kKnotInterval_s)) + 2;
  const size_t count = std::max(static_cast<size_t>(std::ceil(duration_s / kKnotInterval_s)) + 3, num_at_rest + 1);
  Rng rng = MakeRng(seed, RandomStream::kMotion);
  const std::vector<Vector3d> positions = Positions(world, count + 2, num_at_rest, options, rng);
  if (positions.empty()) return std::nullopt;

  const double largest_turn_rad = options.max_turn_rate_radps * kKnotInterval_s;
  Command yaw_step(kYawShare * largest_turn_rad, kYawShare * largest_turn_rad);
  Command pitch(options.max_tilt_rad, kTiltShare * largest_turn_rad);
  Command roll(options.max_tilt_rad, kTiltShare * largest_turn_rad);
  double yaw_rad = Uniform(-std::numbers::pi, std::numbers::pi, rng);
  std::vector<MotionVector> control_points(count);
  for (size_t i = 0; i < count; ++i) {
    control_points[i] << positions[i], yaw_rad, pitch.value(), roll.value();
    if (i < num_at_rest) continue;
    const int knot = static_cast<int>(i - num_at_rest);
    yaw_rad += yaw_step.Wander(knot, rng);
    if (options.carrier == SpatialCarrier::kHandheld) {
      pitch.Wander(knot, rng);
      roll.Wander(knot, rng);
    } else {
      const Vector3d bend_m = positions[i + 2] - 2.0 * positions[i + 1] + positions[i];
      const Tilt tilt = ThrustTilt(bend_m / (kKnotInterval_s * kKnotInterval_s), yaw_rad);
      pitch.Approach(tilt.pitch_rad);
      roll.Approach(tilt.roll_rad);
    }
  }
  return SpatialMotion(kKnotInterval_s, std::move(control_points));
}

}  // namespace lcmslam
