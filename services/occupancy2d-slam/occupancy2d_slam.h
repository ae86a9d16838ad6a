#pragma once

#include "baselines/occupancy2d_pipeline.h"
#include "common/planar_slam_service.h"

namespace lcmslam {

namespace config {
class Occupancy2dSlam;
}

struct Occupancy2dSlamOptions {
  PlanarSlamOptions service;
  occupancy2d::Options slam;
};

// Occupancy grid SLAM after Hector SLAM on the bus.
class Occupancy2dSlam : public PlanarSlamService {
 public:
  using Options = Occupancy2dSlamOptions;
  using Config = config::Occupancy2dSlam;
  static constexpr const char* kName = "occupancy2d-slam";
  static Options Complete(Config& config);

  Occupancy2dSlam(const Options& options, const Config& config, ServiceContext& context);
};

}  // namespace lcmslam
