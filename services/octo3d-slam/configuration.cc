#include "common/slam_config.h"
#include "octo3d-slam/octo3d_slam.h"
#include "octo3d-slam/octo3d_slam.pb.h"

namespace lcmslam {
namespace {

void BindMap(ConfigBinder bind, octo3d::MapOptions& map) {
  bind("leaf_m", map.leaf_m)("levels", map.levels)("range_noise_m", map.range_noise_m)("min_points", map.min_points);
  bind("max_thickness", map.max_thickness)("min_flatness", map.min_flatness);
  bind("curvature_per_m", map.curvature_per_m)("refit_growth", map.refit_growth);
}

void BindPatches(ConfigBinder bind, octo3d::PatchOptions& patches) {
  bind("min_range_m", patches.min_range_m)("max_range_m", patches.max_range_m);
  bind("cell_m", patches.cell_m)("levels", patches.levels);
  bind("time_slices", patches.time_slices)("max_patches", patches.max_patches);
}

void BindRegistration(ConfigBinder bind, octo3d::RegistrationOptions& registration) {
  bind("max_iterations", registration.max_iterations)("kernel", registration.kernel);
  bind("model_error_m", registration.model_error_m);
  bind("step_sigmas", registration.step_sigmas);
  bind("acceleration_mps2", registration.acceleration_mps2);
  bind("angular_acceleration_radps2", registration.angular_acceleration_radps2);
  bind("min_direction_share", registration.min_direction_share);
}

void BindSearch(ConfigBinder bind, octo3d::CoarseSearchOptions& search) {
  bind("max_patches", search.max_patches)("iterations", search.iterations)("reach_m", search.reach_m);
}

void BindTrust(ConfigBinder bind, octo3d::TrustOptions& trust) {
  bind("min_patches", trust.min_patches)("min_inlier_ratio", trust.min_inlier_ratio);
  bind("max_residual", trust.max_residual);
  bind("initial_speed_mps", trust.initial_speed_mps)("initial_rate_radps", trust.initial_rate_radps);
  bind("set_pose_m", trust.set_pose_m)("set_pose_rad", trust.set_pose_rad);
  bind("hint_rotation_rad", trust.hint_rotation_rad)("hint_translation_m", trust.hint_translation_m);
  bind("hint_odometry_rad", trust.hint_odometry_rad)("max_gap_s", trust.max_gap_s);
}

}  // namespace

void BindOptions(config::Octo3dSlam& config, Octo3dSlamOptions& options) {
  octo3d::Options& slam = options.slam;
  ConfigBinder bind(config);
  BindShell(bind, "OCTO3D", options.service);
  bind.Sub("channels")("imu", options.service.imu_channel)("map", options.map_channel);
  bind("load_map", options.service.load_map)("threads", slam.threads)("max_points", slam.max_points);
  bind("update_distance_m", slam.update_distance_m)("update_angle_rad", slam.update_angle_rad);
  BindMap(bind.Sub("map"), slam.map);
  BindPatches(bind.Sub("patches"), slam.patches);
  BindRegistration(bind.Sub("registration"), slam.registration);
  BindSearch(bind.Sub("search"), slam.search);
  BindTrust(bind.Sub("trust"), slam.trust);
  ConfigBinder occupancy = bind.Sub("occupancy");
  occupancy("free_space", options.occupancy.free_space)("max_ray_m", options.occupancy.max_ray_m);
  RequireValid(options.occupancy.Validate());
}

}  // namespace lcmslam
