// One scan through 2D-SDF-SLAM, map update included: quantiles over the scans of a drive.
//   build/bin/sdf2d_bench --benchmark_counters_tabular=true

#include "planar_drive.h"
#include "sdf2d/pipeline.h"

namespace lcmslam {
namespace {

using sdf2d::Options;
using sdf2d::Pipeline;

// Arguments: beams, noise (0 none, 1 low, 2 rated), motion distortion.
void ProcessDrive(benchmark::State& state) {
  const std::vector<PlanarFrame> frames = Drive(state.range(0), NoiseOf(state.range(1)), state.range(2) != 0);
  const Options options{.T_map_body_initial = frames.front().T_world_body};
  ScanTimes times(frames.size());
  double mean_error_m = 0.0;  // not aligned: holds what the first noisy scans turned the map by
  for (auto _ : state) {
    Pipeline pipeline(options);
    mean_error_m = 0.0;
    for (size_t i = 0; i < frames.size(); ++i) {
      const Pose2 T_map_body = times.Measure(i, [&] { return pipeline.Process(frames[i].scan); }).T_map_body;
      mean_error_m += (T_map_body.translation() - frames[i].T_world_body.translation()).norm();
    }
    mean_error_m /= static_cast<double>(frames.size());
    if (!(mean_error_m < 0.15)) state.SkipWithError("lost its way");
  }
  times.Report(state);
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
