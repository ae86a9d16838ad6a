#pragma once

#include <filesystem>

#include "simulation/planar_episode.h"

namespace lcmslam {

namespace config {
class Episode;
}

// The episode of a planar lidar; see MakeEpisode.
[[nodiscard]] PlanarEpisode MakePlanarEpisode(config::Episode& config, const std::filesystem::path& folder);

}  // namespace lcmslam
