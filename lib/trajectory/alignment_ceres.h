#pragma once

#include <span>

#include "trajectory/alignment.h"

namespace lcmslam {

struct CeresAlignmentOptions {
  double huber_m = 0.0;  // distances beyond it weigh linearly; 0: plain least squares
};

struct CeresAlignment {
  bool converged = false;
  Pose3 T_world_map;  // the guess unless converged
};

// The problem of Align() for kYaw, kSe2 and kSe3 solved by iteration from a guess, with an optional robust loss.
// Without one it agrees with the closed form wherever all axes are observable. Poses are finite.
[[nodiscard]] CeresAlignment AlignByCeres(std::span<const PosePair> pairs, AlignmentKind kind,
                                          const Pose3& T_world_map_guess, const CeresAlignmentOptions& options = {});

}  // namespace lcmslam
