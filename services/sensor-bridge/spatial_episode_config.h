#pragma once

#include <filesystem>

#include "simulation/spatial_episode.h"

namespace lcmslam {

namespace config {
class Episode;
}

// The episode of a multi-line lidar; see MakeEpisode.
[[nodiscard]] SpatialEpisode MakeSpatialEpisode(config::Episode& config, const std::filesystem::path& folder);

}  // namespace lcmslam
