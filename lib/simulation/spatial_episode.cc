#include "simulation/spatial_episode.h"

#include <cmath>
#include <utility>

namespace lcmslam {
namespace {

constexpr int64_t kLatestStart = 4'000'000'000'000'000'000;

}  // namespace

std::string SpatialEpisodeOptions::Validate() const {
  if (!(duration_s > 0.0 && duration_s <= 1e5)) return "duration_s: must be in (0, 1e5]";
  if (start_utime < 0 || start_utime > kLatestStart) return "start_utime: must be in 0..4e18";
  if (const std::string error = lidar.Validate(); !error.empty()) return "lidar." + error;
  if (const std::string error = carrier.Validate(); !error.empty()) return "carrier." + error;
  if (const std::string error = imu.Validate(); !error.empty()) return "imu." + error;
  if (const std::string error = odometry.Validate(); !error.empty()) return "odometry." + error;
  return "";
}

std::optional<SpatialEpisode> SpatialEpisode::Create(SpatialWorld world, const SpatialEpisodeOptions& options) {
  if (!options.Validate().empty()) return std::nullopt;
  std::optional<SpatialMotion> motion = CarryAround(world, options.duration_s, options.carrier, options.seed);
  if (!motion) return std::nullopt;
  return SpatialEpisode(std::move(world), *std::move(motion), options);
}

SpatialEpisode::SpatialEpisode(SpatialWorld world, SpatialMotion motion, const SpatialEpisodeOptions& options)
    : world_(std::move(world)),
      motion_(std::move(motion)),
      options_(options),
      imu_(SimulateImu(motion_, options.start_utime, options.imu, options.seed)),
      odometry_(SimulateSpatialOdometry(motion_, options.start_utime, options.odometry, options.seed)) {}

int SpatialEpisode::num_frames() const {
  return static_cast<int>(std::floor(options_.duration_s / options_.lidar.model.turn_s + 1e-9));
}

SpatialFrame SpatialEpisode::Frame(int i) const {
  SimulatedSweep simulated = SimulateSweep(world_, motion_, i, options_.lidar, options_.seed);
  simulated.sweep.utime += options_.start_utime;
  const Pose3 T_world_body = TrueStateAt(simulated.sweep.utime).T_world_body;
  return {std::move(simulated.sweep), T_world_body, simulated.bound};
}

BodyState SpatialEpisode::TrueStateAt(int64_t utime) const {
  return motion_.StateAt(1e-6 * static_cast<double>(utime - options_.start_utime));
}

}  // namespace lcmslam
