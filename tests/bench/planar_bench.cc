// 2D-SDF-SLAM and the occupancy grid baseline (0.025 m, 3 levels) on the same scans in turn: quantiles of the time of a
// scan, map update included, and their ratios, 2D-SDF-SLAM over baseline.
//   build/bin/planar_bench --benchmark_counters_tabular=true

#include "baselines/occupancy2d_pipeline.h"
#include "planar_drive.h"
#include "sdf2d/pipeline.h"

namespace lcmslam {
namespace {

// Arguments: noise (0 none, 1 low, 2 rated), motion distortion.
void CompareSystems(benchmark::State& state) {
  const std::vector<PlanarFrame> frames = Drive(667, NoiseOf(state.range(0)), state.range(1) != 0);
  ScanTimes sdf2d_times(frames.size()), occupancy2d_times(frames.size());
  for (auto _ : state) {
    sdf2d::Pipeline sdf2d(sdf2d::Options{});
    occupancy2d::Pipeline occupancy2d(occupancy2d::Options{});
    Pose2 T_map_body;
    for (size_t i = 0; i < frames.size(); ++i) {
      benchmark::DoNotOptimize(occupancy2d_times.Measure(i, [&] { return occupancy2d.Process(frames[i].scan); }));
      T_map_body = sdf2d_times.Measure(i, [&] { return sdf2d.Process(frames[i].scan); }).T_map_body;
    }
    const Pose2 truth = frames.front().T_world_body.inverse() * frames.back().T_world_body;
    if ((T_map_body.translation() - truth.translation()).norm() > 0.1) state.SkipWithError("lost its way");
  }
  sdf2d_times.Report(state, "sdf_");
  occupancy2d_times.Report(state, "grid_");
  state.counters["median_ratio"] = sdf2d_times.Quantile(0.5) / occupancy2d_times.Quantile(0.5);
  state.counters["p95_ratio"] = sdf2d_times.Quantile(0.95) / occupancy2d_times.Quantile(0.95);
  state.counters["p99_ratio"] = sdf2d_times.Quantile(0.99) / occupancy2d_times.Quantile(0.99);
}
BENCHMARK(CompareSystems)
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2.0)
    ->ArgNames({"noise", "distortion"})
    ->Args({kNone, 0})
    ->Args({kLow, 0})
    ->Args({kRated, 0})
    ->Args({kRated, 1});

}  // namespace
}  // namespace lcmslam
