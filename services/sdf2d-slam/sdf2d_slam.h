#pragma once

#include <memory>
#include <string>

#include "common/configured_slam.h"
#include "common/planar_slam_service.h"
#include "sdf2d/options.h"

namespace lcmslam {

namespace config {
class Sdf2dSlam;
}

struct Sdf2dSlamOptions {
  static constexpr const char* kName = "sdf2d-slam";
  PlanarSlamOptions service;
  std::string map_channel = "SDF2D_MAP";  // "": no tiles
  std::string load_map;                   // "": start with an empty map
  sdf2d::Options slam;
};
void BindOptions(config::Sdf2dSlam& config, Sdf2dSlamOptions& options);
// Throws CommandError (kBadInput) when options.load_map cannot be read.
std::unique_ptr<PlanarSlam> MakeAdapter(const Sdf2dSlamOptions& options);

// 2D-SDF-SLAM on the bus.
using Sdf2dSlam = ConfiguredSlam<PlanarSlamService, config::Sdf2dSlam, Sdf2dSlamOptions>;

}  // namespace lcmslam
