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
  options.service.grid_channel = "OCCUPANCY2D_MAP";
  occupancy2d::Options& slam = options.slam;
  ConfigBinder bind(config);
  BindShell(bind, "OCCUPANCY2D", options.service, slam.T_body_lidar, slam.T_map_body_initial);
  bind("min_range_m", slam.min_range_m)("max_range_m", slam.max_range_m)("localize_only", slam.localize_only);
  bind("levels", slam.levels)("update_distance_m", slam.update_distance_m)("update_angle_rad", slam.update_angle_rad);
  BindGrid(bind.Sub("grid"), slam.grid);
  BindMatch(bind.Sub("match"), slam.match);
}

}  // namespace lcmslam
