#pragma once

#include <memory>

#include "common/planar_slam_service.h"

namespace lcmslam {

struct Sdf2dSlamOptions;

// The sdf2d pipeline as PlanarSlamService drives it. Throws CommandError (kBadInput) when options.load_map cannot be
// read.
std::unique_ptr<PlanarSlam> MakeSdf2dAdapter(const Sdf2dSlamOptions& options);

}  // namespace lcmslam
