#include "octo3d-slam/octo3d_slam.h"

#include "common/config.h"
#include "octo3d-slam/configuration.h"
#include "octo3d-slam/octo3d_adapter.h"
#include "octo3d-slam/octo3d_slam.pb.h"

namespace lcmslam {

Octo3dSlamOptions Octo3dSlam::Complete(Config& config) {
  Options options;
  BindOptions(config, options);
  RequireValid(options.service.Validate());
  RequireValid(options.slam.Validate());
  RequireValid(options.occupancy.Validate());
  return options;
}

Octo3dSlam::Octo3dSlam(const Options& options, const Config& config, ServiceContext& context)
    : SpatialSlamService(options.service, ConfigHash(ConfigText(config)), MakeOcto3dAdapter(options), kName, context) {}

}  // namespace lcmslam
