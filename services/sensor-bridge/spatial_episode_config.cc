#include "sensor-bridge/spatial_episode_config.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/config.h"
#include "sensor-bridge/episode.pb.h"
#include "sensor-bridge/odometry_config.h"
#include "sensor-bridge/spatial_episode_world.h"

namespace lcmslam {
namespace {

// Numbers of the enumerators in episode.proto.
enum class LidarType { kVlp16, kHdl32e, kHdl64e, kOs1_64 };

MultiLineModel ModelOf(LidarType type) {
  switch (type) {
    case LidarType::kVlp16:
      return VelodyneVlp16();
    case LidarType::kHdl32e:
      return VelodyneHdl32e();
    case LidarType::kHdl64e:
      return VelodyneHdl64e();
    case LidarType::kOs1_64:
      return OusterOs1_64();
  }
  return {};
}

void BindLidar(ConfigBinder bind, MultiLineLidarOptions& lidar) {
  LidarType type{};
  bind("type", type)("range_sigma_m", lidar.range_sigma_m)("dropout_probability", lidar.dropout_probability);
  bind("motion_distortion", lidar.motion_distortion);
  lidar.model = ModelOf(type);
  ConfigBinder model = bind.Sub("model");
  model("turn_s", lidar.model.turn_s)("min_range_m", lidar.model.min_range_m)("max_range_m", lidar.model.max_range_m);
  lidar.T_body_lidar = BindSpatialPose(bind.Sub("mounting"));
}

void BindCarrier(ConfigBinder bind, SpatialCarrierOptions& carrier) {
  bind("kind", carrier.carrier)("max_speed_mps", carrier.max_speed_mps);
  bind("max_turn_rate_radps", carrier.max_turn_rate_radps)("max_tilt_rad", carrier.max_tilt_rad);
  bind("min_height_m", carrier.min_height_m)("max_height_m", carrier.max_height_m);
  bind("clearance_m", carrier.clearance_m)("rest_s", carrier.rest_s)("start_in_motion", carrier.start_in_motion);
}

void BindImu(ConfigBinder bind, ImuOptions& imu) {
  bind("rate_hz", imu.rate_hz);
  bind("gyroscope_noise_radps_per_sqrt_hz", imu.gyroscope_noise_radps_per_sqrt_hz);
  bind("gyroscope_bias_sigma_radps", imu.gyroscope_bias_sigma_radps);
  bind("gyroscope_walk_radps2_per_sqrt_hz", imu.gyroscope_walk_radps2_per_sqrt_hz);
  bind("accelerometer_noise_mps2_per_sqrt_hz", imu.accelerometer_noise_mps2_per_sqrt_hz);
  bind("accelerometer_bias_sigma_mps2", imu.accelerometer_bias_sigma_mps2);
  bind("accelerometer_walk_mps3_per_sqrt_hz", imu.accelerometer_walk_mps3_per_sqrt_hz);
}

// SpatialEpisodeOptions names its parts as the file's section `spatial` does.
std::string InFile(const std::string& reason) {
  const bool is_part = reason.find('.') < reason.find(':');
  return is_part ? "spatial." + reason : reason;
}

}  // namespace

SpatialEpisode MakeSpatialEpisode(config::Episode& config, const std::filesystem::path& folder) {
  SpatialEpisodeOptions options;
  ConfigBinder bind(config);
  bind("seed", options.seed)("duration_s", options.duration_s)("start_utime", options.start_utime);
  ConfigBinder spatial = bind.Sub("spatial");
  BindLidar(spatial.Sub("lidar"), options.lidar);
  BindCarrier(spatial.Sub("carrier"), options.carrier);
  BindImu(spatial.Sub("imu"), options.imu);
  BindOdometry(spatial.Sub("odometry"), options.odometry);
  RequireValid(InFile(options.Validate()));

  SpatialWorld world = MakeSpatialWorld(*config.mutable_spatial()->mutable_world(), folder);
  std::optional<SpatialEpisode> episode = SpatialEpisode::Create(std::move(world), options);
  if (!episode) RequireValid("spatial.carrier.clearance_m: the world leaves no room to move");
  if (episode->num_frames() == 0) RequireValid("duration_s: shorter than one sweep");
  return *std::move(episode);
}

}  // namespace lcmslam
