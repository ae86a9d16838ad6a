#pragma once

#include <filesystem>
#include <variant>

#include "simulation/planar_episode.h"
#include "simulation/spatial_episode.h"

namespace lcmslam {

namespace config {
class Episode;
}

using Episode = std::variant<PlanarEpisode, SpatialEpisode>;

// The episode that the configuration describes; paths in it are relative to `folder`. Fills in what is unset. Throws
// CommandError with one line that names the field: kUsage, or kBadInput for a map that cannot be read.
[[nodiscard]] Episode MakeEpisode(config::Episode& config, const std::filesystem::path& folder);

}  // namespace lcmslam
