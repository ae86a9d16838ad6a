#pragma once

#include <memory>

#include "baselines/occupancy2d_pipeline.h"
#include "common/planar_slam_service.h"

namespace lcmslam {

// The occupancy grid pipeline as PlanarSlamService drives it.
std::unique_ptr<PlanarSlam> MakeOccupancy2dAdapter(const occupancy2d::Options& options);

}  // namespace lcmslam
