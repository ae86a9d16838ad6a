#pragma once

#include <string>

#include "common/spatial_slam_service.h"
#include "octo3d/occupancy_export.h"
#include "octo3d/options.h"

namespace lcmslam {

namespace config {
class Octo3dSlam;
}

struct Octo3dSlamOptions {
  SpatialSlamOptions service;
  std::string map_channel = "OCTO3D_MAP";  // "": no surfels
  octo3d::Options slam;
  octo3d::OccupancyExportOptions occupancy;
};

// NOctoSLAM on the bus.
class Octo3dSlam : public SpatialSlamService {
 public:
  using Options = Octo3dSlamOptions;
  using Config = config::Octo3dSlam;
  static constexpr const char* kName = "octo3d-slam";
  static Options Complete(Config& config);

  Octo3dSlam(const Options& options, const Config& config, ServiceContext& context);
};

}  // namespace lcmslam
