#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "sensor-bridge/episode.pb.h"
#include "simulation/planar_episode.h"
#include "simulation/planar_world.h"

namespace lcmslam {

// The world that the field planar.world of an episode describes, at the start; see MakeEpisode.
[[nodiscard]] PlanarWorld MakePlanarWorld(config::Episode::World& config, const std::filesystem::path& folder,
                                          uint64_t seed);
// What becomes of it while the robot drives; none where it stays as it is.
[[nodiscard]] std::optional<WorldChange> MakeWorldChange(config::Episode::World& config,
                                                         const std::filesystem::path& folder);

}  // namespace lcmslam
