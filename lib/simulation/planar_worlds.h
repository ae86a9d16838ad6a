#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "simulation/planar_world.h"

namespace lcmslam {

PlanarWorld Room5World();     // 5 x 5 m with four boxes
PlanarWorld Stdr10World();    // 10 x 10 m: slanted walls, a U-shaped wall, an open-bottom box, a turned rectangle
PlanarWorld Mocap5World();    // 5 x 5 m: desks before a wall, wall segments, radiator ribs
PlanarWorld CorridorWorld();  // 30 x 2 m, bare in the middle, door recesses near the ends

// "room5", "stdr10", "mocap5" or "corridor"; none for other names.
[[nodiscard]] std::optional<PlanarWorld> NamedPlanarWorld(std::string_view name);

// The world with up to `count` boxes of 0.2 to 0.8 m more in its free space, at least min_gap_m from all else; fewer
// where there is no room. Deterministic in the seed.
[[nodiscard]] PlanarWorld WithRandomBoxes(PlanarWorld world, int count, double min_gap_m, uint64_t seed);

}  // namespace lcmslam
