#pragma once

#include <memory>

#include "baselines/cloud3d_pipeline.h"
#include "common/spatial_slam_service.h"

namespace lcmslam {

// The cloud3d pipeline as SpatialSlamService drives it.
std::unique_ptr<SpatialSlam> MakeCloud3dAdapter(const cloud3d::Options& options);

}  // namespace lcmslam
