// One scan through 2D-SDF-SLAM, map update included. median_ms and p95_ms are over the scans of a drive, each scan's
// time being its best over all iterations, so that other work on the machine does not count.
//   build/bin/sdf2d_bench --benchmark_counters_tabular=true

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include <benchmark/benchmark.h>

#include "sdf2d/pipeline.h"
#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using sdf2d::Options;
using sdf2d::Pipeline;
using Clock = std::chrono::steady_clock;

enum Noise { kNone, kLow, kRated };

RangeNoise NoiseOf(int64_t noise) {
  return noise == kNone ? RangeNoise::None() : noise == kLow ? RangeNoise::Low() : RangeNoise::Rated();
}

std::vector<PlanarFrame> Drive(int beams, const RangeNoise& noise, bool distortion) {
  PlanarLidarModel model = HokuyoUrg04LxUg01();
  model.angle_step_rad *= static_cast<double>(model.num_beams - 1) / (beams - 1);
  model.num_beams = beams;
  const auto episode =
      PlanarEpisode::Create(Room5World(), {.seed = 5,
                                           .lidar = {.model = model, .noise = noise, .motion_distortion = distortion},
                                           .drive = {.drive = PlanarDrive::kOmnidirectional}});
  std::vector<PlanarFrame> frames;
  for (int i = 0; i < episode->num_frames(); ++i) frames.push_back(episode->Frame(i));
  return frames;
}

double Quantile(std::vector<double> values, double q) {
  const auto nth = values.begin() + static_cast<ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// Arguments: beams, noise (0 none, 1 low, 2 rated), motion distortion.
void ProcessDrive(benchmark::State& state) {
  const std::vector<PlanarFrame> frames =
      Drive(static_cast<int>(state.range(0)), NoiseOf(state.range(1)), state.range(2) != 0);
  const Options options{.T_map_body_initial = frames.front().T_world_body};
  std::vector<double> scan_ms(frames.size(), std::numeric_limits<double>::infinity());
  double mean_error_m = 0.0;  // not aligned: holds what the first noisy scans turned the map by
  for (auto _ : state) {
    Pipeline pipeline(options);
    mean_error_m = 0.0;
    for (size_t i = 0; i < frames.size(); ++i) {
      const Clock::time_point start = Clock::now();
      const Pose2 T_map_body = pipeline.Process(frames[i].scan).T_map_body;
      scan_ms[i] = std::min(scan_ms[i], std::chrono::duration<double, std::milli>(Clock::now() - start).count());
      mean_error_m += (T_map_body.translation() - frames[i].T_world_body.translation()).norm();
    }
    mean_error_m /= static_cast<double>(frames.size());
    if (!(mean_error_m < 0.15)) state.SkipWithError("lost its way");
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * frames.size()));
  state.counters["median_ms"] = Quantile(scan_ms, 0.5);
  state.counters["p95_ms"] = Quantile(scan_ms, 0.95);
  state.counters["p99_ms"] = Quantile(scan_ms, 0.99);
  state.counters["error_mm"] = 1e3 * mean_error_m;
}
BENCHMARK(ProcessDrive)
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2.0)
    ->ArgNames({"beams", "noise", "distortion"})
    ->Args({667, kNone, 0})
    ->Args({667, kLow, 0})
    ->Args({667, kLow, 1})
    ->Args({667, kRated, 0})
    ->Args({667, kRated, 1})
    ->Args({181, kLow, 0})
    ->Args({1081, kLow, 0});

}  // namespace
}  // namespace lcmslam
