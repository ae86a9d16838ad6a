#include "sensor-bridge/planar_episode_world.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bus/errors.h"
#include "common/config.h"
#include "simulation/planar_map.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

constexpr const char* kDefaultWorld = "room5";
constexpr int kMaxRandomBoxes = 1000;

PlanarWorld NamedWorld(const std::string& name) {
  std::optional<PlanarWorld> world = NamedPlanarWorld(name);
  if (!world) RequireValid(fmt::format("planar.world.name: no world is called '{}'", name));
  return *std::move(world);
}

PlanarWorld MapWorld(const std::filesystem::path& yaml_path) {
  try {
    return WorldOf(ReadPlanarMap(yaml_path));
  } catch (const BadMap& error) {
    throw CommandError(ExitCode::kBadInput, fmt::format("planar.world.map: {}", error.what()));
  }
}

// What segments and boxes are added to.
PlanarWorld BaseWorld(config::Episode::World& config, const std::filesystem::path& folder) {
  const bool has_parts = config.segment_size() > 0 || config.box_size() > 0;
  if (!config.has_name() && !config.has_map() && !has_parts) config.set_name(kDefaultWorld);
  if (config.has_name() && config.has_map()) RequireValid("planar.world.map: planar.world.name is set as well");
  if (config.has_name()) return NamedWorld(config.name());
  return config.has_map() ? MapWorld(folder / config.map()) : PlanarWorld({});
}

void AddSegments(const config::Episode::World& config, std::vector<Segment>& walls) {
  for (int i = 0; i < config.segment_size(); ++i) {
    const auto& segment = config.segment(i);
    walls.push_back({Vector2d(segment.x1_m(), segment.y1_m()), Vector2d(segment.x2_m(), segment.y2_m())});
    if (!walls.back().a.allFinite() || !walls.back().b.allFinite())
      RequireValid(fmt::format("planar.world.segment[{}]: must be finite", i));
  }
}

using Boxes = google::protobuf::RepeatedPtrField<config::Episode::Box>;

void AddBoxes(const char* name, const Boxes& boxes, std::vector<Segment>& walls) {
  for (int i = 0; i < boxes.size(); ++i) {
    const auto& box = boxes[i];
    for (const double number : {box.x_m(), box.y_m(), box.yaw_rad(), box.length_m(), box.width_m()}) {
      if (!std::isfinite(number)) RequireValid(fmt::format("planar.world.{}[{}]: must be finite", name, i));
    }
    const auto outline = BoxOutline({box.x_m(), box.y_m()}, box.length_m(), box.width_m(), box.yaw_rad());
    walls.insert(walls.end(), outline.begin(), outline.end());
  }
}

PlanarWorld AddRandomBoxes(PlanarWorld world, config::Episode::RandomBoxes& config, uint64_t seed) {
  int count = 0;
  double min_gap_m = 0.7;
  ConfigBinder(config, "planar.world.random_boxes.")("count", count)("min_gap_m", min_gap_m);
  if (count < 0 || count > kMaxRandomBoxes) RequireValid("planar.world.random_boxes.count: must be in 0..1000");
  if (min_gap_m < 0.0) RequireValid("planar.world.random_boxes.min_gap_m: must not be negative");
  return WithRandomBoxes(std::move(world), count, min_gap_m, seed);
}

PlanarWorld WorldWith(const char* name, const Boxes& boxes, config::Episode::World& config,
                      const std::filesystem::path& folder) {
  const PlanarWorld base = BaseWorld(config, folder);
  std::vector<Segment> walls(base.walls().begin(), base.walls().end());
  AddSegments(config, walls);
  AddBoxes(name, boxes, walls);
  return PlanarWorld(std::move(walls), {base.barriers().begin(), base.barriers().end()});
}

}  // namespace

PlanarWorld MakePlanarWorld(config::Episode::World& config, const std::filesystem::path& folder, uint64_t seed) {
  return AddRandomBoxes(WorldWith("box", config.box(), config, folder), *config.mutable_random_boxes(), seed);
}

std::optional<WorldChange> MakeWorldChange(config::Episode::World& config, const std::filesystem::path& folder) {
  double at_s = 0.0;
  ConfigBinder(config, "planar.world.")("moved_at_s", at_s);
  if (config.moved_box_size() == 0) return std::nullopt;
  if (config.random_boxes().count() > 0) RequireValid("planar.world.random_boxes: not together with moved_box");
  return WorldChange{at_s, WorldWith("moved_box", config.moved_box(), config, folder)};
}

}  // namespace lcmslam
