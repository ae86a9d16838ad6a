#pragma once

#include <cstdint>
#include <filesystem>

#include "sensor-bridge/episode.pb.h"
#include "simulation/planar_world.h"

namespace lcmslam {

// The world that the field planar.world of an episode describes; see MakeEpisode.
[[nodiscard]] PlanarWorld MakePlanarWorld(config::Episode::World& config, const std::filesystem::path& folder,
                                          uint64_t seed);

}  // namespace lcmslam
