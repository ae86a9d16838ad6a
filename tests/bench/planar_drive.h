#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

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

// The time of every scan of a drive: its best over all iterations, so that other work on the machine does not count.
class ScanTimes {
 public:
  explicit ScanTimes(size_t scans) : best_ms_(scans, std::numeric_limits<double>::infinity()) {}

  // Runs and times `process` on the i-th scan.
  template <typename Process>
  auto Measure(size_t i, Process&& process) {
    const auto start = std::chrono::steady_clock::now();
    auto result = std::forward<Process>(process)();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    best_ms_[i] = std::min(best_ms_[i], elapsed.count());
    return result;
  }

  double Quantile(double q) const {
    std::vector<double> values = best_ms_;
    const auto nth = values.begin() + static_cast<ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  }

  // Counters PREFIXmedian_ms, PREFIXp95_ms, PREFIXp99_ms.
  void Report(benchmark::State& state, const std::string& prefix = "") const {
    state.counters[prefix + "median_ms"] = Quantile(0.5);
    state.counters[prefix + "p95_ms"] = Quantile(0.95);
    state.counters[prefix + "p99_ms"] = Quantile(0.99);
  }

 private:
  std::vector<double> best_ms_;
};

}  // namespace lcmslam
