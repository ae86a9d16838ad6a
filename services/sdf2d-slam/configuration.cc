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
  bind("predict", motion.predict)("acceleration", motion.acceleration)("angular_acceleration",
                                                                       motion.angular_acceleration);
  bind("start_speed", motion.start_speed)("start_turn_rate", motion.start_turn_rate)("max_gap_s", motion.max_gap_s);
  bind("start_sigma_m", motion.start_sigma_m)("start_sigma_rad", motion.start_sigma_rad);
  bind("odometry_slip", motion.odometry_slip)("odometry_sigma_m", motion.odometry_sigma_m);
  bind("odometry_sigma_rad", motion.odometry_sigma_rad)("max_odometry_gap_s", motion.max_odometry_gap_s);
}

void BindRegistration(ConfigBinder bind, sdf2d::RegistrationOptions& registration) {
  bind("max_iterations", registration.max_iterations)("huber_sigmas", registration.huber_sigmas);
  bind("inlier_sigmas", registration.inlier_sigmas)("map_sigma_m", registration.map_sigma_m);
  bind("min_cos_incidence", registration.min_cos_incidence)("shared_sigma_m", registration.shared_sigma_m);
  bind("shared_length_m", registration.shared_length_m)("independence", registration.independence);
  bind("max_skew_rad", registration.max_skew_rad)("stop_sigmas", registration.stop_sigmas);
  bind("min_eigenvalue", registration.min_eigenvalue)("min_points", registration.min_points);
}

void BindSurface(ConfigBinder bind, sdf2d::SurfaceOptions& surface) {
  bind("split_chi2", surface.split_chi2)("min_beams", surface.min_beams);
  bind("max_incidence_rad", surface.max_incidence_rad)("max_gap_m", surface.max_gap_m)("max_piece_m",
                                                                                       surface.max_piece_m);
}

void BindFusion(ConfigBinder bind, sdf2d::FusionOptions& fusion) {
  bind("band_cells", fusion.band_cells)("band_sigmas", fusion.band_sigmas)("max_band_m", fusion.max_band_m);
  bind("distance_sigma", fusion.distance_sigma)("end_sigma", fusion.end_sigma)("end_cells", fusion.end_cells);
  bind("sigma_floor_m", fusion.sigma_floor_m)("max_information", fusion.max_information);
  bind("change_sigmas", fusion.change_sigmas)("change_m", fusion.change_m)("change_keep", fusion.change_keep);
  bind("update_distance_m", fusion.update_distance_m)("update_angle_rad", fusion.update_angle_rad);
  bind("carve", fusion.carve)("carve_every", fusion.carve_every)("carve_keep", fusion.carve_keep);
}

void BindRecovery(ConfigBinder bind, sdf2d::RecoveryOptions& recovery) {
  bind("min_inlier_ratio", recovery.min_inlier_ratio)("min_overlap", recovery.min_overlap);
  bind("min_found_ratio", recovery.min_found_ratio)("suspicious_drop", recovery.suspicious_drop);
  bind("max_surprise_sigmas", recovery.max_surprise_sigmas)("max_turn_rate", recovery.max_turn_rate);
  bind("search_m", recovery.search_m)("search_rad", recovery.search_rad)("max_search_m", recovery.max_search_m);
  bind("patience", recovery.patience);
}

}  // namespace

void BindOptions(config::Sdf2dSlam& config, Sdf2dSlamOptions& options) {
  sdf2d::Options& slam = options.slam;
  ConfigBinder bind(config);
  BindShell(bind, "SDF2D", options.service, slam.T_body_lidar, slam.T_map_body_initial);
  bind.Sub("channels")("map", options.map_channel);
  bind("cell_m", slam.cell_m)("min_range_m", slam.min_range_m)("max_range_m", slam.max_range_m);
  bind("deskew", slam.deskew)("localize_only", slam.localize_only)("load_map", options.load_map);
  BindNoise(bind.Sub("noise"), slam.noise);
  BindMotion(bind.Sub("motion"), slam.motion);
  bind("coarse_cell_m", slam.coarse_cell_m);
  BindRegistration(bind.Sub("registration"), slam.registration);
  BindSurface(bind.Sub("surface"), slam.surface);
  BindFusion(bind.Sub("fusion"), slam.fusion);
  BindRecovery(bind.Sub("recovery"), slam.recovery);
}

}  // namespace lcmslam
