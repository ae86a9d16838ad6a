#pragma once

#include "simulation/spatial_episode.h"

namespace lcmslam {

namespace config {
class Episode;
}

// The episode of a multi-line lidar; see MakeEpisode.
[[nodiscard]] SpatialEpisode MakeSpatialEpisode(config::Episode& config);

}  // namespace lcmslam
