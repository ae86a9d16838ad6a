// One scan through the occupancy grid baseline, map update included. median_ms and p95_ms are over the scans of a
// drive, each scan's time being its best over all iterations, so that other work on the machine does not count.
//   build/bin/occupancy2d_bench --benchmark_counters_tabular=true

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include <benchmark/benchmark.h>

#include "baselines/occupancy2d_pipeline.h"
#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using occupancy2d::Options;
using occupancy2d::Pipeline;
using Clock = std::chrono::steady_clock;

std::vector<PlanarFrame> Drive(int beams) {
  PlanarLidarModel model = HokuyoUrg04LxUg01();
  model.angle_step_rad *= static_cast<double>(model.num_beams - 1) / (beams - 1);
  model.num_beams = beams;
  const auto episode = PlanarEpisode::Create(
      Room5World(), {.seed = 5,
                     .lidar = {.model = model, .noise = RangeNoise::Low(), .motion_distortion = false},
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

// Arguments: beams, the finest cells in mm, the update angle in mrad.
void ProcessDrive(benchmark::State& state) {
  const std::vector<PlanarFrame> frames = Drive(static_cast<int>(state.range(0)));
  const Options options{.grid = {.cell_m = 1e-3 * static_cast<double>(state.range(1))},
                        .update_angle_rad = 1e-3 * static_cast<double>(state.range(2))};
  std::vector<double> scan_ms(frames.size(), std::numeric_limits<double>::infinity());
  for (auto _ : state) {
    Pipeline pipeline(options);
    Pose2 T_map_body;
    for (size_t i = 0; i < frames.size(); ++i) {
      const Clock::time_point start = Clock::now();
      T_map_body = pipeline.Process(frames[i].scan).T_map_body;
      scan_ms[i] = std::min(scan_ms[i], std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    const Pose2 truth = frames.front().T_world_body.inverse() * frames.back().T_world_body;
    if ((T_map_body.translation() - truth.translation()).norm() > 0.1) state.SkipWithError("lost its way");
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * frames.size()));
  state.counters["median_ms"] = Quantile(scan_ms, 0.5);
  state.counters["p95_ms"] = Quantile(scan_ms, 0.95);
}
BENCHMARK(ProcessDrive)
    ->Unit(benchmark::kMillisecond)
    ->ArgNames({"beams", "cell_mm", "update_mrad"})
    ->Args({667, 25, 900})
    ->Args({667, 50, 60})
    ->Args({181, 25, 900})
    ->Args({1081, 25, 900});

}  // namespace
}  // namespace lcmslam
