#pragma once

#include <vector>

#include "scan_times.h"
#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

// The drive that planar systems are timed on, and how they are.
namespace lcmslam {

// As an argument of a benchmark.
enum NoiseArgument { kNone, kLow, kRated };

inline RangeNoise NoiseOf(int64_t noise) {
  return noise == kNone ? RangeNoise::None() : noise == kLow ? RangeNoise::Low() : RangeNoise::Rated();
}

// A minute in the 5x5 m room; the lidar's 240 degrees in so many beams.
inline std::vector<PlanarFrame> Drive(int64_t beams, const RangeNoise& noise, bool distortion) {
  PlanarLidarModel model = HokuyoUrg04LxUg01();
  model.angle_step_rad *= static_cast<double>(model.num_beams - 1) / static_cast<double>(beams - 1);
  model.num_beams = static_cast<int>(beams);
  const auto episode =
      PlanarEpisode::Create(Room5World(), {.seed = 5,
                                           .lidar = {.model = model, .noise = noise, .motion_distortion = distortion},
                                           .drive = {.drive = PlanarDrive::kOmnidirectional}});
  std::vector<PlanarFrame> frames;
  for (int i = 0; i < episode->num_frames(); ++i) frames.push_back(episode->Frame(i));
  return frames;
}

}  // namespace lcmslam
