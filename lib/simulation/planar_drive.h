#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "simulation/planar_motion.h"
#include "simulation/planar_world.h"

namespace lcmslam {

enum class PlanarDrive { kDifferential, kOmnidirectional };

struct PlanarDriveOptions {
  PlanarDrive drive = PlanarDrive::kDifferential;
  double max_speed_mps = 1.0;
  double max_yaw_rate_radps = 0.5;
  double max_acceleration_mps2 = 1.0;
  double max_yaw_acceleration_radps2 = 1.0;
  double clearance_m = 0.3;  // from the body's origin to the nearest obstacle, never less

  std::string Validate() const;
};

// Drives from a random place, at rest, to random goals for at least duration_s. Like the dynamic window approach
// (Fox, Burgard, Thrun 1997) it takes a command only if the robot can afterwards still brake in free space, so it keeps
// its clearance by construction. None where the world has no free space of that clearance. Deterministic in the seed.
[[nodiscard]] std::optional<PlanarMotion> DriveAround(const PlanarWorld& world, double duration_s, int64_t start_utime,
                                                      const PlanarDriveOptions& options, uint64_t seed);

}  // namespace lcmslam
