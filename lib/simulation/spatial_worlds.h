#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "simulation/spatial_world.h"

namespace lcmslam {

// What a world is made of.
struct SpatialParts {
  std::vector<Solid> solids;
  Eigen::Vector3d p_inside = Eigen::Vector3d::Zero();  // see SpatialWorld
};

// "hall10", "bare_room" or "corridor40"; none for other names.
[[nodiscard]] std::optional<SpatialParts> NamedSpatialParts(std::string_view name);
[[nodiscard]] std::optional<SpatialWorld> NamedSpatialWorld(std::string_view name);

// 10 x 8 x 3 m, barrel-vaulted: furniture, pillars, radiators, an arched window.
SpatialWorld Hall10World();
// 6 x 5 x 2.7 m, nothing in it.
SpatialWorld BareRoomWorld();
// 40 x 2 x 2.6 m, door frames 3 cm proud of the walls.
SpatialWorld Corridor40World();

}  // namespace lcmslam
