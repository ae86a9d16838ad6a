// NOctoSLAM and the point cloud baseline on the same sweeps in turn (VLP-16, furnished hall): quantiles of the time of
// a sweep, map update included; iterations per second on the same points; and the ratios, in favour of NOctoSLAM.
//   build/bin/spatial_bench --benchmark_counters_tabular=true

#include "baselines/cloud3d_pipeline.h"
#include "octo3d/pipeline.h"
#include "scan_times.h"
#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"

namespace lcmslam {
namespace {

std::vector<SpatialFrame> HallFrames(bool distortion) {
  SpatialEpisodeOptions options;
  options.seed = 5;
  options.duration_s = 12.0;
  options.lidar.motion_distortion = distortion;
  options.lidar.range_sigma_m = distortion ? 0.03 : 0.02;
  const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(Hall10World(), options);
  std::vector<SpatialFrame> frames;
  for (int i = 0; i < episode->num_frames(); ++i) frames.push_back(episode->Frame(i));
  return frames;
}

double Distance(const Pose3& T_map_body, const std::vector<SpatialFrame>& frames) {
  const Pose3 truth = frames.front().T_world_body.inverse() * frames.back().T_world_body;
  return (T_map_body.translation - truth.translation).norm();
}

// Argument: motion distortion.
void CompareSystems(benchmark::State& state) {
  const std::vector<SpatialFrame> frames = HallFrames(state.range(0) != 0);
  ScanTimes octo3d_times(frames.size()), cloud3d_times(frames.size());
  for (auto _ : state) {
    octo3d::Pipeline octo3d(octo3d::Options{});
    cloud3d::Pipeline cloud3d(cloud3d::Options{});
    Pose3 T_octo3d, T_cloud3d;
    for (size_t i = 0; i < frames.size(); ++i) {
      T_cloud3d = cloud3d_times.Measure(i, [&] { return cloud3d.Process(frames[i].sweep); }).T_map_body;
      T_octo3d = octo3d_times.Measure(i, [&] { return octo3d.Process(frames[i].sweep); }).T_map_body;
    }
    if (Distance(T_octo3d, frames) > 0.1 || Distance(T_cloud3d, frames) > 0.3) state.SkipWithError("lost its way");
  }
  octo3d_times.Report(state, "octo_");
  cloud3d_times.Report(state, "cloud_");
  state.counters["median_ratio"] = cloud3d_times.Quantile(0.5) / octo3d_times.Quantile(0.5);
  state.counters["p95_ratio"] = cloud3d_times.Quantile(0.95) / octo3d_times.Quantile(0.95);
}
BENCHMARK(CompareSystems)->Unit(benchmark::kMillisecond)->Iterations(2)->ArgName("distortion")->Arg(0)->Arg(1);

// Both register the filtered points of the last sweep, one by one, to their maps of the sweeps before.
void CompareIterations(benchmark::State& state) {
  const std::vector<SpatialFrame> frames = HallFrames(false);
  octo3d::Pipeline octo3d(octo3d::Options{});
  cloud3d::Pipeline cloud3d(cloud3d::Options{});
  for (size_t i = 0; i + 1 < frames.size(); ++i) {
    (void)octo3d.Process(frames[i].sweep);
    (void)cloud3d.Process(frames[i].sweep);
  }
  std::mt19937_64 random(1);
  const cloud3d::Cloud cloud = cloud3d::Filter(frames.back().sweep, cloud3d.options().filter, random);
  std::vector<octo3d::Patch> patches;
  for (const Eigen::Vector3f& p : cloud.points) patches.push_back({.mean = p.cast<double>(), .count = 1.0F});
  const Pose3 guess = frames.front().T_world_body.inverse() * frames[frames.size() - 2].T_world_body;
  octo3d::StateBelief belief;
  belief.mean.T_map_body = guess;
  const octo3d::TimedPatches timed{patches, 0, 0.1};
  const octo3d::MotionSegment start = octo3d::PredictMotion(belief, {}, timed.duration_s);

  ScanTimes octo3d_times(1), cloud3d_times(1);
  octo3d::RegistrationResult octo3d_result;
  cloud3d::IcpResult cloud3d_result;
  for (auto _ : state) {
    cloud3d_result = cloud3d_times.Measure(0, [&] { return Icp(cloud3d.map(), cloud, guess, cloud3d.options().icp); });
    octo3d_result = octo3d_times.Measure(
        0, [&] { return Register(octo3d.map(), timed, belief, {}, start, octo3d.options().registration); });
  }
  if (Distance(octo3d_result.motion.to().T_map_body, frames) > 0.1 || Distance(cloud3d_result.T_map_body, frames) > 0.1)
    state.SkipWithError("lost its way");
  const double octo3d_hz = 1e3 * octo3d_result.iterations / octo3d_times.Quantile(0.5);
  const double cloud3d_hz = 1e3 * cloud3d_result.iterations / cloud3d_times.Quantile(0.5);
  state.counters["points"] = static_cast<double>(cloud.size());
  state.counters["octo_per_s"] = octo3d_hz;
  state.counters["cloud_per_s"] = cloud3d_hz;
  state.counters["ratio"] = octo3d_hz / cloud3d_hz;
}
BENCHMARK(CompareIterations)->Unit(benchmark::kMillisecond)->Iterations(50);

}  // namespace
}  // namespace lcmslam
