#include "simulation/planar_episode.h"

#include <cmath>
#include <utility>

#include "simulation/random.h"

namespace lcmslam {
namespace {

constexpr int64_t kLatestStart = 4'000'000'000'000'000'000;

// All that stands in either.
PlanarWorld Both(const PlanarWorld& a, const PlanarWorld& b) {
  std::vector<Segment> walls(a.walls().begin(), a.walls().end());
  walls.insert(walls.end(), b.walls().begin(), b.walls().end());
  std::vector<Segment> barriers(a.barriers().begin(), a.barriers().end());
  barriers.insert(barriers.end(), b.barriers().begin(), b.barriers().end());
  return PlanarWorld(std::move(walls), std::move(barriers));
}

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

std::optional<PlanarEpisode> PlanarEpisode::Create(PlanarWorld world, const PlanarEpisodeOptions& options,
                                                   std::optional<WorldChange> change) {
  if (!options.Validate().empty()) return std::nullopt;
  const PlanarWorld obstacles = change ? Both(world, change->world) : world;
  std::optional<PlanarMotion> motion =
      DriveAround(obstacles, options.duration_s, options.start_utime, options.drive, options.seed);
  if (!motion) return std::nullopt;
  std::vector<Person> people = SimulatePeople(obstacles, *motion, options.people, options.seed);
  return PlanarEpisode(std::move(world), std::move(change), *std::move(motion), std::move(people), options);
}

PlanarEpisode::PlanarEpisode(PlanarWorld world, std::optional<WorldChange> change, PlanarMotion motion,
                             std::vector<Person> people, const PlanarEpisodeOptions& options)
    : world_(std::move(world)),
      change_(std::move(change)),
      motion_(std::move(motion)),
      options_(options),
      odometry_(SimulateOdometry(motion_, options.odometry, options.seed)),
      people_(std::move(people)) {}

const PlanarWorld& PlanarEpisode::WorldAt(int64_t utime) const {
  const bool changed = change_ && static_cast<double>(utime - options_.start_utime) >= 1e6 * change_->at_s;
  return changed ? change_->world : world_;
}

int PlanarEpisode::num_frames() const {
  const PlanarLidarModel& model = options_.lidar.model;
  return std::max(0, 1 + static_cast<int>(std::floor((options_.duration_s - model.sweep_s()) / model.turn_s)));
}

PlanarFrame PlanarEpisode::Frame(int i) const {
  const PlanarLidarModel& model = options_.lidar.model;
  const int64_t utime = options_.start_utime + std::llround(1e6 * (i * model.turn_s + model.sweep_s()));
  Rng rng = MakeRng(options_.seed, RandomStream::kRange, static_cast<uint64_t>(i));
  const auto T_world_body = [this](int64_t time) { return motion_.PoseAt(time); };
  SimulatedScan simulated = SimulateScan(WorldAt(utime), people_, T_world_body, utime, options_.lidar, rng);
  return {std::move(simulated.scan), motion_.PoseAt(utime), motion_.TwistAt(utime), simulated.bound};
}

}  // namespace lcmslam
