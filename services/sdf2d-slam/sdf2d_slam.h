#pragma once

#include "common/planar_slam_service.h"
#include "sdf2d/options.h"

namespace lcmslam {

namespace config {
class Sdf2dSlam;
}

struct Sdf2dSlamOptions {
  PlanarSlamOptions service;
  std::string map_channel = "SDF2D_MAP";  // "": no tiles
  std::string load_map;                   // "": start with an empty map
  sdf2d::Options slam;
};

// 2D-SDF-SLAM on the bus.
class Sdf2dSlam : public PlanarSlamService {
 public:
  using Options = Sdf2dSlamOptions;
  using Config = config::Sdf2dSlam;
  static constexpr const char* kName = "sdf2d-slam";
  static Options Complete(Config& config);

  Sdf2dSlam(const Options& options, const Config& config, ServiceContext& context);
};

}  // namespace lcmslam
