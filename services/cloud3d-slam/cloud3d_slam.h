#pragma once

#include <memory>

#include "baselines/cloud3d_pipeline.h"
#include "common/configured_slam.h"
#include "common/spatial_slam_service.h"

namespace lcmslam {

namespace config {
class Cloud3dSlam;
}

struct Cloud3dSlamOptions {
  static constexpr const char* kName = "cloud3d-slam";
  SpatialSlamOptions service;
  cloud3d::Options slam;
};
void BindOptions(config::Cloud3dSlam& config, Cloud3dSlamOptions& options);
std::unique_ptr<SpatialSlam> MakeAdapter(const Cloud3dSlamOptions& options);

// The libpointmatcher-type baseline on the bus.
using Cloud3dSlam = ConfiguredSlam<SpatialSlamService, config::Cloud3dSlam, Cloud3dSlamOptions>;

}  // namespace lcmslam
