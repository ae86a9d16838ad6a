// NOctoSLAM by its parts, in the furnished hall with a VLP-16, and the map update against the size of the map.
//   build/bin/octo3d_bench
//   build/bin/octo3d_bench --benchmark_filter=Update

#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "octo3d/patches.h"
#include "octo3d/pipeline.h"
#include "octo3d/surfel_map.h"
#include "simulation/spatial_episode.h"
#include "simulation/spatial_worlds.h"

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

// Whole sweeps, in a map that is a few seconds old at first.
void ProcessSweep(benchmark::State& state) {
  const std::vector<Sweep> sweeps = HallSweeps(20.0);
  constexpr size_t kWarmUp = 50;
  std::unique_ptr<Pipeline> pipeline;
  size_t next = sweeps.size();
  for (auto _ : state) {
    if (next == sweeps.size()) {
      state.PauseTiming();
      pipeline = std::make_unique<Pipeline>(Options{});
      for (next = 0; next < kWarmUp; ++next) (void)pipeline->Process(sweeps[next]);
      state.ResumeTiming();
    }
    if (pipeline->Process(sweeps[next++]).status != SweepStatus::kTracking) state.SkipWithError("lost");
  }
}
BENCHMARK(ProcessSweep)->Unit(benchmark::kMillisecond);

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
  if (map.ChangedSince(map.revision() - 1).size() < 1000) state.SkipWithError("no surfels");
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
