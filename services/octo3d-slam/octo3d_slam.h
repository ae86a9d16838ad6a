#pragma once

#include <memory>
#include <string>

#include "common/configured_slam.h"
#include "common/spatial_slam_service.h"
#include "octo3d/occupancy_export.h"
#include "octo3d/options.h"

namespace lcmslam {

namespace config {
class Octo3dSlam;
}

struct Octo3dSlamOptions {
  static constexpr const char* kName = "octo3d-slam";
  SpatialSlamOptions service;
  std::string map_channel = "OCTO3D_MAP";  // "": no surfels
  octo3d::Options slam;
  octo3d::OccupancyExportOptions occupancy;
};
void BindOptions(config::Octo3dSlam& config, Octo3dSlamOptions& options);
std::unique_ptr<SpatialSlam> MakeAdapter(const Octo3dSlamOptions& options);

// NOctoSLAM on the bus.
using Octo3dSlam = ConfiguredSlam<SpatialSlamService, config::Octo3dSlam, Octo3dSlamOptions>;

}  // namespace lcmslam
