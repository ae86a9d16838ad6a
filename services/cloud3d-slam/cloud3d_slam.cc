#include "cloud3d-slam/cloud3d_slam.h"

#include "cloud3d-slam/cloud3d_adapter.h"
#include "cloud3d-slam/cloud3d_slam.pb.h"
#include "cloud3d-slam/configuration.h"
#include "common/config.h"

namespace lcmslam {

Cloud3dSlamOptions Cloud3dSlam::Complete(Config& config) {
  Options options;
  BindOptions(config, options);
  RequireValid(options.service.Validate());
  RequireValid(options.slam.Validate());
  return options;
}

Cloud3dSlam::Cloud3dSlam(const Options& options, const Config& config, ServiceContext& context)
    : SpatialSlamService(options.service, ConfigHash(ConfigText(config)), MakeCloud3dAdapter(options.slam), kName,
                         context) {}

}  // namespace lcmslam
