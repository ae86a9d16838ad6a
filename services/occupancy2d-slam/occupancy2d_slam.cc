#include "occupancy2d-slam/occupancy2d_slam.h"

#include "common/config.h"
#include "occupancy2d-slam/configuration.h"
#include "occupancy2d-slam/occupancy2d_adapter.h"
#include "occupancy2d-slam/occupancy2d_slam.pb.h"

namespace lcmslam {

Occupancy2dSlamOptions Occupancy2dSlam::Complete(Config& config) {
  Options options;
  BindOptions(config, options);
  RequireValid(options.service.Validate());
  RequireValid(options.slam.Validate());
  return options;
}

Occupancy2dSlam::Occupancy2dSlam(const Options& options, const Config& config, ServiceContext& context)
    : PlanarSlamService(options.service, ConfigHash(ConfigText(config)), MakeOccupancy2dAdapter(options.slam), kName,
                        context) {}

}  // namespace lcmslam
