#include "sdf2d-slam/sdf2d_slam.h"

#include "common/config.h"
#include "sdf2d-slam/configuration.h"
#include "sdf2d-slam/sdf2d_adapter.h"
#include "sdf2d-slam/sdf2d_slam.pb.h"

namespace lcmslam {

Sdf2dSlamOptions Sdf2dSlam::Complete(Config& config) {
  Options options;
  BindOptions(config, options);
  RequireValid(options.service.Validate());
  RequireValid(options.slam.Validate());
  return options;
}

Sdf2dSlam::Sdf2dSlam(const Options& options, const Config& config, ServiceContext& context)
    : PlanarSlamService(options.service, ConfigHash(ConfigText(config)), MakeSdf2dAdapter(options), kName, context) {}

}  // namespace lcmslam
