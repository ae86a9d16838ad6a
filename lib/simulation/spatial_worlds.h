#pragma once

#include <optional>
#include <string_view>

#include "simulation/spatial_world.h"

namespace lcmslam {

// 10 x 8 x 3 m, barrel-vaulted: furniture, pillars, radiators, an arched window.
SpatialWorld Hall10World();
// 6 x 5 x 2.7 m, nothing in it.
SpatialWorld BareRoomWorld();
// 40 x 2 x 2.6 m, door frames 3 cm proud of the walls.
SpatialWorld Corridor40World();

// "hall10", "bare_room" or "corridor40"; none for other names.
[[nodiscard]] std::optional<SpatialWorld> NamedSpatialWorld(std::string_view name);

}  // namespace lcmslam
