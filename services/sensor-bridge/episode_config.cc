#include "sensor-bridge/episode_config.h"

#include "common/config.h"
#include "sensor-bridge/episode.pb.h"
#include "sensor-bridge/planar_episode_config.h"
#include "sensor-bridge/spatial_episode_config.h"

namespace lcmslam {

Episode MakeEpisode(config::Episode& config, const std::filesystem::path& folder) {
  if (config.has_planar() && config.has_spatial()) RequireValid("spatial: planar is set as well");
  if (config.has_spatial()) return MakeSpatialEpisode(config, folder);
  return MakePlanarEpisode(config, folder);
}

}  // namespace lcmslam
