#include "sdf2d-slam/configuration.h"

#include "common/slam_config.h"
#include "sdf2d-slam/sdf2d_slam.h"
#include "sdf2d-slam/sdf2d_slam.pb.h"

namespace lcmslam {
namespace {

void BindNoise(ConfigBinder bind, sdf2d::NoiseOptions& noise) {
  bind("estimate", noise.estimate)("constant_m", noise.constant_m)("proportional", noise.proportional);
  bind("floor_m", noise.floor_m);
}

void BindMotion(ConfigBinder bind, sdf2d::MotionOptions& motion) {
  bind("acceleration", motion.acceleration)("angular_acceleration", motion.angular_acceleration);
  bind("start_speed", motion.start_speed)("start_turn_rate", motion.start_turn_rate)("max_gap_s", motion.max_gap_s);
  bind("odometry_slip", motion.odometry_slip)("odometry_sigma_m", motion.odometry_sigma_m);
  bind("odometry_sigma_rad", motion.odometry_sigma_rad)("max_odometry_gap_s", motion.max_odometry_gap_s);
}

}  // namespace

void BindOptions(config::Sdf2dSlam& config, Sdf2dSlamOptions& options) {
  options.service.pose_channel = "SDF2D_POSE";
  options.service.diagnostics_channel = "SDF2D_DIAGNOSTICS";
  options.service.mounting_configured = config.has_mounting();
  sdf2d::Options& slam = options.slam;
  ConfigBinder bind(config);
  ConfigBinder channels = bind.Sub("channels");
  BindChannels(channels, options.service);
  channels("map", options.map_channel);
  if (config.has_mounting()) BindPose(bind.Sub("mounting"), slam.T_body_lidar);
  BindPose(bind.Sub("initial_pose"), slam.T_map_body_initial);
  bind("cell_m", slam.cell_m)("min_range_m", slam.min_range_m)("max_range_m", slam.max_range_m);
  bind("deskew", slam.deskew)("localize_only", slam.localize_only)("load_map", options.load_map);
  BindNoise(bind.Sub("noise"), slam.noise);
  BindMotion(bind.Sub("motion"), slam.motion);
}

}  // namespace lcmslam
