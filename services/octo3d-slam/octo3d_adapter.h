#pragma once

#include <memory>

#include "common/spatial_slam_service.h"

namespace lcmslam {

struct Octo3dSlamOptions;

// The octo3d pipeline as SpatialSlamService drives it.
std::unique_ptr<SpatialSlam> MakeOcto3dAdapter(const Octo3dSlamOptions& options);

}  // namespace lcmslam
