#include "cloud3d-slam/cloud3d_slam.h"
#include "cloud3d-slam/cloud3d_slam.pb.h"
#include "common/slam_config.h"

namespace lcmslam {
namespace {

void BindFilter(ConfigBinder bind, cloud3d::FilterOptions& filter) {
  bind("min_range_m", filter.min_range_m)("max_range_m", filter.max_range_m)("keep_ratio", filter.keep_ratio);
  bind("voxel_m", filter.voxel_m)("normal_neighbours", filter.normal_neighbours);
}

void BindIcp(ConfigBinder bind, cloud3d::IcpOptions& icp) {
  bind("neighbours", icp.neighbours)("epsilon", icp.epsilon)("max_distance_m", icp.max_distance_m);
  bind("trim_ratio", icp.trim_ratio)("max_normal_angle_rad", icp.max_normal_angle_rad);
  bind("max_iterations", icp.max_iterations)("smoothed_steps", icp.smoothed_steps);
  bind("min_step_m", icp.min_step_m)("min_step_rad", icp.min_step_rad)("min_overlap", icp.min_overlap);
}

void BindMap(ConfigBinder bind, cloud3d::Options& slam) {
  bind("spacing_m", slam.map.spacing_m);
  bind("update_distance_m", slam.update_distance_m)("update_angle_rad", slam.update_angle_rad);
}

}  // namespace

void BindOptions(config::Cloud3dSlam& config, Cloud3dSlamOptions& options) {
  cloud3d::Options& slam = options.slam;
  ConfigBinder bind(config);
  BindShell(bind, "CLOUD3D", options.service);
  bind("reading_ratio", slam.reading_ratio)("max_gap_s", slam.max_gap_s)("reach_last_point", slam.reach_last_point)(
      "seed", slam.seed);
  BindFilter(bind.Sub("filter"), slam.filter);
  BindIcp(bind.Sub("icp"), slam.icp);
  BindMap(bind.Sub("map"), slam);
}

}  // namespace lcmslam
