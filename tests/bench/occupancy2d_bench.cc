// One scan through the occupancy grid baseline, map update included: quantiles over the scans of a drive.
//   build/bin/occupancy2d_bench --benchmark_counters_tabular=true

#include "baselines/occupancy2d_pipeline.h"
#include "planar_drive.h"

namespace lcmslam {
namespace {

using occupancy2d::Options;
using occupancy2d::Pipeline;

// Arguments: beams, the finest cells in mm, the update angle in mrad.
void ProcessDrive(benchmark::State& state) {
  const std::vector<PlanarFrame> frames = Drive(state.range(0), RangeNoise::Low(), false);
  const Options options{.grid = {.cell_m = 1e-3 * static_cast<double>(state.range(1))},
                        .update_angle_rad = 1e-3 * static_cast<double>(state.range(2))};
  ScanTimes times(frames.size());
  for (auto _ : state) {
    Pipeline pipeline(options);
    Pose2 T_map_body;
    for (size_t i = 0; i < frames.size(); ++i) {
      T_map_body = times.Measure(i, [&] { return pipeline.Process(frames[i].scan); }).T_map_body;
    }
    const Pose2 truth = frames.front().T_world_body.inverse() * frames.back().T_world_body;
    if ((T_map_body.translation() - truth.translation()).norm() > 0.1) state.SkipWithError("lost its way");
  }
  times.Report(state);
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
