#include "simulation/planar_episode.h"

#include <cmath>
#include <utility>

#include "simulation/random.h"

namespace lcmslam {
namespace {

constexpr int64_t kLatestStart = 4'000'000'000'000'000'000;

}  // namespace

std::string PlanarEpisodeOptions::Validate() const {
  if (!(duration_s > 0.0 && duration_s <= 1e5)) return "duration_s: must be in (0, 1e5]";
  if (start_utime < 0 || start_utime > kLatestStart) return "start_utime: must be in 0..4e18";
  if (const std::string error = lidar.Validate(); !error.empty()) return "lidar." + error;
  if (const std::string error = drive.Validate(); !error.empty()) return "drive." + error;
  if (const std::string error = odometry.Validate(); !error.empty()) return "odometry." + error;
  if (const std::string error = people.Validate(); !error.empty()) return "people." + error;
  return "";
}

std::optional<PlanarEpisode> PlanarEpisode::Create(PlanarWorld world, const PlanarEpisodeOptions& options) {
  if (!options.Validate().empty()) return std::nullopt;
  std::optional<PlanarMotion> motion =
      DriveAround(world, options.duration_s, options.start_utime, options.drive, options.seed);
  if (!motion) return std::nullopt;
  return PlanarEpisode(std::move(world), *std::move(motion), options);
}

PlanarEpisode::PlanarEpisode(PlanarWorld world, PlanarMotion motion, const PlanarEpisodeOptions& options)
    : world_(std::move(world)),
      motion_(std::move(motion)),
      options_(options),
      odometry_(SimulateOdometry(motion_, options.odometry, options.seed)),
      people_(SimulatePeople(world_, motion_, options.people, options.seed)) {}

int PlanarEpisode::num_frames() const {
  const PlanarLidarModel& model = options_.lidar.model;
  return std::max(0, 1 + static_cast<int>(std::floor((options_.duration_s - model.sweep_s()) / model.turn_s)));
}

PlanarFrame PlanarEpisode::Frame(int i) const {
  const PlanarLidarModel& model = options_.lidar.model;
  const int64_t utime = options_.start_utime + std::llround(1e6 * (i * model.turn_s + model.sweep_s()));
  Rng rng = MakeRng(options_.seed, RandomStream::kRange, static_cast<uint64_t>(i));
  const auto T_world_body = [this](int64_t time) { return motion_.PoseAt(time); };
  SimulatedScan simulated = SimulateScan(world_, people_, T_world_body, utime, options_.lidar, rng);
  return {std::move(simulated.scan), motion_.PoseAt(utime), motion_.TwistAt(utime), simulated.bound};
}

}  // namespace lcmslam
