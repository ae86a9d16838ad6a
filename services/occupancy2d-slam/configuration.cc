#include "occupancy2d-slam/configuration.h"

#include "common/slam_config.h"
#include "occupancy2d-slam/occupancy2d_slam.h"
#include "occupancy2d-slam/occupancy2d_slam.pb.h"

namespace lcmslam {
namespace {

void BindGrid(ConfigBinder bind, occupancy2d::LogOddsGrid::Options& grid) {
  bind("cell_m", grid.cell_m)("max_extent_m", grid.max_extent_m);
  bind("probability_free", grid.probability_free)("probability_occupied", grid.probability_occupied);
}

void BindMatch(ConfigBinder bind, occupancy2d::MatchOptions& match) {
  bind("coarse_steps", match.coarse_steps)("fine_steps", match.fine_steps);
  bind("max_rotation_step_rad", match.max_rotation_step_rad)("gradient", match.gradient);
}

}  // namespace

void BindOptions(config::Occupancy2dSlam& config, Occupancy2dSlamOptions& options) {
  options.service.pose_channel = "OCCUPANCY2D_POSE";
  options.service.diagnostics_channel = "OCCUPANCY2D_DIAGNOSTICS";
  options.service.grid_channel = "OCCUPANCY2D_MAP";
  options.service.mounting_configured = config.has_mounting();
  occupancy2d::Options& slam = options.slam;
  ConfigBinder bind(config);
  BindChannels(bind.Sub("channels"), options.service);
  if (config.has_mounting()) BindPose(bind.Sub("mounting"), slam.T_body_lidar);
  BindPose(bind.Sub("initial_pose"), slam.T_map_body_initial);
  bind("min_range_m", slam.min_range_m)("max_range_m", slam.max_range_m)("localize_only", slam.localize_only);
  bind("levels", slam.levels)("update_distance_m", slam.update_distance_m)("update_angle_rad", slam.update_angle_rad);
  BindGrid(bind.Sub("grid"), slam.grid);
  BindMatch(bind.Sub("match"), slam.match);
}

}  // namespace lcmslam
