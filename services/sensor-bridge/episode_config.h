#pragma once

#include <filesystem>

#include "simulation/planar_episode.h"

namespace lcmslam {

namespace config {
class Episode;
}

// The episode that the configuration describes; paths in it are relative to `folder`. Fills in what is unset. Throws
// CommandError with one line that names the field: kUsage, or kBadInput for a map that cannot be read.
[[nodiscard]] PlanarEpisode MakePlanarEpisode(config::Episode& config, const std::filesystem::path& folder);

}  // namespace lcmslam
