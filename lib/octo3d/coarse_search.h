#pragma once

#include "octo3d/motion.h"
#include "octo3d/options.h"
#include "octo3d/registration.h"
#include "octo3d/surfel_map.h"

namespace lcmslam::octo3d {

struct CoarseSearchResult {
  Pose3 T_map_body;           // at the sweep's end
  double inlier_ratio = 0.0;  // of all patches used
};

// Rigid point-to-plane registration from a rough guess: nearest surfel in a wide neighbourhood, a Geman-McClure kernel
// that narrows. The motion within the sweep is taken from `guess`. Pure.
[[nodiscard]] CoarseSearchResult SearchCoarsely(const SurfelMap& map, const TimedPatches& sweep,
                                                const MotionSegment& guess, const CoarseSearchOptions& options);

}  // namespace lcmslam::octo3d
