#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "simulation/spatial_motion.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

// What carries the lidar: a hand that points it anywhere, or a multicopter that tilts to accelerate.
enum class SpatialCarrier { kHandheld, kMulticopter };

struct SpatialCarrierOptions {
  SpatialCarrier carrier = SpatialCarrier::kHandheld;
  double max_speed_mps = 1.0;
  double max_turn_rate_radps = 1.0;  // of the whole rotation, never exceeded
  double max_tilt_rad = 0.35;        // of roll and of pitch
  double min_height_m = 0.8;         // of the body's origin
  double max_height_m = 1.8;
  double clearance_m = 0.3;      // from the body's origin to the nearest surface, never less
  double rest_s = 1.0;           // at rest and level at first
  bool start_in_motion = false;  // no rest: at time 0 the body already moves

  std::string Validate() const;
};

// Wanders between random places for at least duration_s, about 0.7 max_speed_mps on average. None where the way out
// from the world's p_inside is blocked. Deterministic in the seed.
[[nodiscard]] std::optional<SpatialMotion> CarryAround(const SpatialWorld& world, double duration_s,
                                                       const SpatialCarrierOptions& options, uint64_t seed);

}  // namespace lcmslam
