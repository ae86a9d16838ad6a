#pragma once

#include <filesystem>

#include "common/config.h"
#include "sensor-bridge/episode.pb.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

// The world that the field spatial.world of an episode describes; see MakeEpisode.
[[nodiscard]] SpatialWorld MakeSpatialWorld(config::Episode::SpatialWorld& config, const std::filesystem::path& folder);

// The pose that a SpatialPose describes.
[[nodiscard]] Pose3 BindSpatialPose(ConfigBinder bind);

}  // namespace lcmslam
