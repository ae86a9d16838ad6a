#pragma once

#include "baselines/cloud3d_pipeline.h"
#include "common/spatial_slam_service.h"

namespace lcmslam {

namespace config {
class Cloud3dSlam;
}

struct Cloud3dSlamOptions {
  SpatialSlamOptions service;
  cloud3d::Options slam;
};

// The libpointmatcher-type baseline on the bus.
class Cloud3dSlam : public SpatialSlamService {
 public:
  using Options = Cloud3dSlamOptions;
  using Config = config::Cloud3dSlam;
  static constexpr const char* kName = "cloud3d-slam";
  static Options Complete(Config& config);

  Cloud3dSlam(const Options& options, const Config& config, ServiceContext& context);
};

}  // namespace lcmslam
