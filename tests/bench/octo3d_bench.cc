// NOctoSLAM on simulated episodes of a VLP-16 (29k points a sweep): error and time together; its parts; the map update
// against the size of the map. Times are of the computing thread.
//   build/bin/octo3d_bench --benchmark_filter=Episode
//   build/bin/octo3d_bench --benchmark_filter=Update

#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "octo3d/patches.h"
#include "octo3d/pipeline.h"
#include "octo3d/surfel_map.h"
#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"
#include "trajectory/evaluate.h"

namespace lcmslam::octo3d {
namespace {

std::vector<Sweep> HallSweeps(double duration_s) {
  SpatialEpisodeOptions options;
  options.duration_s = duration_s;
  const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(Hall10World(), options);
  std::vector<Sweep> sweeps;
  for (int i = 0; i < episode->num_frames(); ++i) sweeps.push_back(episode->Frame(i).sweep);
  return sweeps;
}

double ThreadMs() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// One episode of 60 s a run, each with another seed; none of them was tuned on.
void Episode(benchmark::State& state, const std::string& world, SpatialEpisodeOptions options) {
  options.seed = 100;
  std::vector<double> ms;
  double mean_m = 0.0, rmse_m = 0.0, mean_rad = 0.0;
  int not_tracked = 0, degenerate = 0;
  for (auto _ : state) {
    ++options.seed;
    const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(*NamedSpatialWorld(world), options);
    Pipeline pipeline{Options{}};
    Trajectory estimate, truth;
    double episode_ms = 0.0;
    for (int i = 0; i < episode->num_frames(); ++i) {
      const SpatialFrame frame = episode->Frame(i);
      const double start_ms = ThreadMs();
      const Result result = pipeline.Process(frame.sweep);
      ms.push_back(ThreadMs() - start_ms);
      episode_ms += ms.back();
      not_tracked += i > 0 && result.status != SweepStatus::kTracking;
      degenerate += result.unobservable.cols() > 0;
      estimate.push_back({result.utime, result.T_map_body});
      truth.push_back({frame.sweep.utime, frame.T_world_body});
    }
    state.SetIterationTime(1e-3 * episode_ms);
    const Evaluation evaluation = Evaluate(estimate, truth, {.alignment = AlignmentKind::kSe3});
    mean_m += evaluation.absolute.translation_m.mean;
    rmse_m += evaluation.absolute.translation_m.rmse;
    mean_rad += evaluation.absolute.rotation_rad.mean;
  }
  const Summary time_ms = Summarize(ms);
  const auto runs = static_cast<double>(state.iterations());
  state.counters["mean_mm"] = 1e3 * mean_m / runs;
  state.counters["rmse_mm"] = 1e3 * rmse_m / runs;
  state.counters["mean_mrad"] = 1e3 * mean_rad / runs;
  state.counters["sweep_ms_median"] = time_ms.median;
  state.counters["sweep_ms_p95"] = time_ms.p95;
  state.counters["not_tracked"] = not_tracked;
  state.counters["degenerate"] = degenerate;
}
SpatialEpisodeOptions Vlp16(double range_sigma_m, bool motion_distortion) {
  SpatialEpisodeOptions options;
  options.lidar.range_sigma_m = range_sigma_m;
  options.lidar.motion_distortion = motion_distortion;
  return options;
}
SpatialEpisodeOptions FastTurns() {
  SpatialEpisodeOptions options = Vlp16(0.03, true);
  options.carrier.max_turn_rate_radps = 2.0;
  options.lidar.dropout_probability = 0.2;
  return options;
}
SpatialEpisodeOptions MovingStart() {
  SpatialEpisodeOptions options = Vlp16(0.03, true);
  options.carrier.start_in_motion = true;
  return options;
}
#define EPISODES(name, ...) \
  BENCHMARK_CAPTURE(Episode, name, __VA_ARGS__)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond)
EPISODES(hall_distortion_30mm, "hall10", Vlp16(0.03, true));
EPISODES(hall_no_distortion_20mm, "hall10", Vlp16(0.02, false));
EPISODES(hall_2_radps_dropouts, "hall10", FastTurns());
EPISODES(hall_moving_start, "hall10", MovingStart());
EPISODES(corridor, "corridor40", Vlp16(0.03, true));
EPISODES(bare_room, "bare_room", Vlp16(0.03, true));

void CondenseSweep(benchmark::State& state) {
  const std::vector<Sweep> sweeps = HallSweeps(1.0);
  const Options options;
  size_t next = 0, patches = 0;
  for (auto _ : state)
    patches = MakePatches(sweeps[next++ % sweeps.size()], options.patches, options.map.range_noise_m).size();
  if (patches < 500) state.SkipWithError("too few patches");
  state.counters["patches"] = static_cast<double>(patches);
}
BENCHMARK(CondenseSweep)->Unit(benchmark::kMillisecond);

// A gently waved floor in pieces of 20 x 20 m and one sweep's worth of points, side by side.
class FloorMaker {
 public:
  std::vector<Eigen::Vector3f> Piece(int i) const {
    std::vector<Eigen::Vector3f> points;
    points.reserve(kPoints);
    const float x0 = 20.0F * (i % 150 - 75), y0 = 20.0F * (i / 150 - 75);
    for (int k = 0; k < kPoints; ++k) {
      const float u = 20.0F * static_cast<float>((k * 7919LL) % kPoints) / kPoints, v = 20.0F * k / kPoints;
      points.emplace_back(x0 + u, y0 + v, 0.1F + 0.03F * std::sin(0.7F * u) + 0.01F * std::sin(997.0F * v));
    }
    return points;
  }
  static constexpr int kPoints = 29000;
};

// A map of at least this many cells; returns the pieces it took.
int Grow(SurfelMap& map, const FloorMaker& floor, int64_t cells) {
  int pieces = 0;
  while (map.num_cells() < static_cast<size_t>(cells)) map.Insert(floor.Piece(pieces++), Eigen::Vector3f(0, 0, 2));
  return pieces;
}

// One update, normals included, of a map of state.range(0) cells.
enum class Ground { kNew, kSame, kFarAway };
void Update(benchmark::State& state, Ground ground) {
  SurfelMap map{MapOptions{}};
  const FloorMaker floor;
  const int pieces = Grow(map, floor, state.range(0));
  int next = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const auto piece = floor.Piece(ground == Ground::kNew    ? pieces + next
                                   : ground == Ground::kSame ? pieces - 1
                                                             : next * 37 % pieces);
    ++next;
    state.ResumeTiming();
    map.Insert(piece, Eigen::Vector3f(0, 0, 2));
  }
  if (map.ChangedSince(0).size() < 1000) state.SkipWithError("no surfels");
  state.counters["cells"] = static_cast<double>(map.num_cells());
}
// Nothing but new cells (the map grows by them); the place last seen again; another old place every time, cold in the
// caches.
void UpdateOnNewGround(benchmark::State& state) { Update(state, Ground::kNew); }
void UpdateOnTheSpot(benchmark::State& state) { Update(state, Ground::kSame); }
void UpdateFarAway(benchmark::State& state) { Update(state, Ground::kFarAway); }
BENCHMARK(UpdateOnNewGround)
    ->RangeMultiplier(10)
    ->Range(10'000, 10'000'000)
    ->Iterations(50)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(UpdateOnTheSpot)
    ->RangeMultiplier(10)
    ->Range(10'000, 10'000'000)
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(UpdateFarAway)
    ->RangeMultiplier(10)
    ->Range(10'000, 10'000'000)
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lcmslam::octo3d
