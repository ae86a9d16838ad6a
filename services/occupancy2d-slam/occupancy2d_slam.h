#pragma once

#include <memory>

#include "baselines/occupancy2d_pipeline.h"
#include "common/configured_slam.h"
#include "common/planar_slam_service.h"

namespace lcmslam {

namespace config {
class Occupancy2dSlam;
}

struct Occupancy2dSlamOptions {
  static constexpr const char* kName = "occupancy2d-slam";
  PlanarSlamOptions service;
  occupancy2d::Options slam;
};
void BindOptions(config::Occupancy2dSlam& config, Occupancy2dSlamOptions& options);
std::unique_ptr<PlanarSlam> MakeAdapter(const Occupancy2dSlamOptions& options);

// Occupancy grid SLAM after Hector SLAM on the bus.
using Occupancy2dSlam = ConfiguredSlam<PlanarSlamService, config::Occupancy2dSlam, Occupancy2dSlamOptions>;

}  // namespace lcmslam
