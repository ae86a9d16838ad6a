// Simulated sweeps of the furnished hall; "x_real_time" counts how many live sensors one core keeps up with.
//   build/bin/simulation_bench

#include <string>

#include <benchmark/benchmark.h>

#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"

namespace lcmslam {
namespace {

void SimulateSweeps(benchmark::State& state, const std::string& lidar) {
  SpatialEpisodeOptions options;
  options.lidar.model = *NamedMultiLineModel(lidar);
  const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(Hall10World(), options);
  const double shots = static_cast<double>(options.lidar.model.lasers.size()) * 1e6 * options.lidar.model.turn_s /
                       options.lidar.model.firing_cycle_us;
  int sweep = 0;
  double points = 0.0;
  for (auto _ : state) {
    const SpatialFrame frame = episode->Frame(sweep++ % episode->num_frames());
    points = static_cast<double>(frame.sweep.points.size());
    if (points < 0.5 * shots) state.SkipWithError("most shots are lost");
  }
  const double sweeps = static_cast<double>(state.iterations());
  state.counters["points"] = points;
  state.counters["x_real_time"] = benchmark::Counter(sweeps * options.lidar.model.turn_s, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(SimulateSweeps, vlp16, "vlp16")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SimulateSweeps, hdl32e, "hdl32e")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SimulateSweeps, hdl64e, "hdl64e")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SimulateSweeps, os1_64, "os1-64")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lcmslam
