#include "sensor-bridge/planar_episode_config.h"

#include <optional>
#include <string>
#include <utility>

#include "common/config.h"
#include "sensor-bridge/episode.pb.h"
#include "sensor-bridge/odometry_config.h"
#include "sensor-bridge/planar_episode_world.h"

namespace lcmslam {
namespace {

// Numbers of the enumerators in episode.proto.
enum class LidarType { kUrg04LxUg01, kUtm30Lx, kRplidarA1, kRplidarA2 };
enum class NoiseLevel { kNone, kLow, kRated };

PlanarLidarModel ModelOf(LidarType type) {
  switch (type) {
    case LidarType::kUrg04LxUg01:
      return HokuyoUrg04LxUg01();
    case LidarType::kUtm30Lx:
      return HokuyoUtm30Lx();
    case LidarType::kRplidarA1:
      return RplidarA1();
    case LidarType::kRplidarA2:
      return RplidarA2();
  }
  return {};
}

RangeNoise NoiseOf(NoiseLevel level) {
  switch (level) {
    case NoiseLevel::kNone:
      return RangeNoise::None();
    case NoiseLevel::kLow:
      return RangeNoise::Low();
    case NoiseLevel::kRated:
      return RangeNoise::Rated();
  }
  return {};
}

void BindModel(ConfigBinder bind, PlanarLidarModel& model) {
  bind("first_angle_rad", model.first_angle_rad)("angle_step_rad", model.angle_step_rad)("num_beams", model.num_beams);
  bind("turn_s", model.turn_s)("min_range_m", model.min_range_m)("max_range_m", model.max_range_m);
}

void BindLidar(ConfigBinder bind, PlanarLidarOptions& lidar) {
  LidarType type{};
  NoiseLevel noise_level{};
  bind("type", type)("noise_level", noise_level)("motion_distortion", lidar.motion_distortion);
  lidar.model = ModelOf(type);
  BindModel(bind.Sub("model"), lidar.model);
  lidar.noise = NoiseOf(noise_level);
  bind.Sub("noise")("sigma_m", lidar.noise.sigma_m)("relative_sigma", lidar.noise.relative_sigma);
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  bind.Sub("mounting")("x_m", x_m)("y_m", y_m)("yaw_rad", yaw_rad);
  lidar.T_body_lidar = Pose2(x_m, y_m, yaw_rad);
}

void BindDrive(ConfigBinder bind, PlanarDriveOptions& drive) {
  bind("kind", drive.drive)("max_speed_mps", drive.max_speed_mps)("max_yaw_rate_radps", drive.max_yaw_rate_radps);
  bind("max_acceleration_mps2", drive.max_acceleration_mps2);
  bind("max_yaw_acceleration_radps2", drive.max_yaw_acceleration_radps2)("clearance_m", drive.clearance_m);
}

void BindPeople(ConfigBinder bind, PlanarPeopleOptions& people) {
  bind("count", people.count)("radius_m", people.radius_m)("speed_mps", people.speed_mps);
  bind("robot_distance_m", people.robot_distance_m);
}

// Throws unless `reason` is "".
void RequireValidPart(const char* path, const std::string& reason) {
  if (!reason.empty()) RequireValid(path + reason);
}

}  // namespace

PlanarEpisode MakePlanarEpisode(config::Episode& config, const std::filesystem::path& folder) {
  PlanarEpisodeOptions options;
  ConfigBinder bind(config);
  bind("seed", options.seed)("duration_s", options.duration_s)("start_utime", options.start_utime);
  ConfigBinder planar = bind.Sub("planar");
  BindLidar(planar.Sub("lidar"), options.lidar);
  BindDrive(planar.Sub("drive"), options.drive);
  BindOdometry(planar.Sub("odometry"), options.odometry);
  BindPeople(planar.Sub("people"), options.people);
  RequireValidPart("planar.lidar.", options.lidar.Validate());
  RequireValidPart("planar.drive.", options.drive.Validate());
  RequireValidPart("planar.odometry.", options.odometry.Validate());
  RequireValidPart("planar.people.", options.people.Validate());
  RequireValid(options.Validate());

  config::Episode::World& world = *config.mutable_planar()->mutable_world();
  std::optional<PlanarEpisode> episode =
      PlanarEpisode::Create(MakePlanarWorld(world, folder, options.seed), options, MakeWorldChange(world, folder));
  if (!episode) RequireValid("planar.drive.clearance_m: the world leaves the robot no room");
  if (episode->num_frames() == 0) RequireValid("duration_s: shorter than one scan");
  return *std::move(episode);
}

}  // namespace lcmslam
