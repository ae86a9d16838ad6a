#include "simulation/planar_worlds.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <boost/random/uniform_real_distribution.hpp>

#include "geometry/angles.h"
#include "simulation/planar_free_space.h"
#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

constexpr int kTrialsPerBox = 100;

// Collects the parts of a world.
class Builder {
 public:
  Builder& Line(std::vector<Vector2d> points) { return Add(Polyline(points, false)); }
  Builder& Loop(std::vector<Vector2d> points) { return Add(Polyline(points, true)); }
  Builder& Box(double x_m, double y_m, double length_m, double width_m, double yaw_deg = 0.0) {
    return Add(BoxOutline({x_m, y_m}, length_m, width_m, DegToRad(yaw_deg)));
  }
  PlanarWorld Build() { return PlanarWorld(std::move(walls_)); }

 private:
  Builder& Add(const std::vector<Segment>& segments) {
    walls_.insert(walls_.end(), segments.begin(), segments.end());
    return *this;
  }
  std::vector<Segment> walls_;
};

}  // namespace

PlanarWorld Room5World() {
  return Builder()
      .Loop({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {0.0, 5.0}})
      .Box(1.4, 3.9, 1.2, 0.6, 10.0)
      .Box(3.9, 3.6, 0.5, 0.8, -20.0)
      .Box(1.1, 1.4, 0.3, 0.9)
      .Box(3.4, 1.3, 0.35, 0.35, 45.0)
      .Build();
}

PlanarWorld Stdr10World() {
  return Builder()
      .Loop({{0.1, 0.0}, {9.9, 0.3}, {10.0, 9.8}, {0.0, 10.0}})
      .Line({{2.0, 6.0}, {2.0, 8.2}, {4.6, 8.2}, {4.6, 6.0}})  // U, open below
      .Line({{6.4, 2.0}, {6.4, 3.6}, {8.4, 3.6}, {8.4, 2.0}})  // box without its bottom
      .Box(3.0, 2.8, 1.8, 0.9, 30.0)
      .Build();
}

PlanarWorld Mocap5World() {
  Builder builder;
  builder.Loop({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {0.0, 5.0}});
  for (const double x_m : {0.6, 2.1, 2.3, 3.8}) {  // two desks along the upper wall: legs and a drawer unit each
    builder.Box(x_m, 4.9, 0.05, 0.05).Box(x_m, 4.25, 0.05, 0.05);
  }
  builder.Box(1.75, 4.6, 0.4, 0.55).Box(3.45, 4.6, 0.4, 0.55);
  builder.Box(1.25, 1.2, 1.0, 0.08, 35.0).Box(3.7, 1.9, 1.2, 0.08, -70.0);  // free-standing wall segments
  builder.Box(0.15, 2.6, 0.3, 0.5);                                         // cupboard
  constexpr int kRibs = 20;
  for (int i = 0; i < kRibs; ++i) builder.Box(4.9, 2.2 + 0.08 * i, 0.12, 0.03);  // radiator
  return builder.Build();
}

PlanarWorld CorridorWorld() {
  return Builder()
      .Line({{0.0, 0.0},    {3.0, 0.0},  {3.0, -0.15}, {3.9, -0.15}, {3.9, 0.0},  {26.0, 0.0},  {26.0, -0.15},
             {26.9, -0.15}, {26.9, 0.0}, {30.0, 0.0},  {30.0, 2.0},  {28.0, 2.0}, {28.0, 2.15}, {27.1, 2.15},
             {27.1, 2.0},   {6.0, 2.0},  {6.0, 2.15},  {5.1, 2.15},  {5.1, 2.0},  {0.0, 2.0},   {0.0, 0.0}})
      .Build();
}

std::optional<PlanarWorld> NamedPlanarWorld(std::string_view name) {
  if (name == "room5") return Room5World();
  if (name == "stdr10") return Stdr10World();
  if (name == "mocap5") return Mocap5World();
  if (name == "corridor") return CorridorWorld();
  return std::nullopt;
}

PlanarWorld WithRandomBoxes(PlanarWorld world, int count, double min_gap_m, uint64_t seed) {
  Rng rng = MakeRng(seed, RandomStream::kObjects);
  boost::random::uniform_real_distribution<double> side_m(0.2, 0.8);
  boost::random::uniform_real_distribution<double> yaw_rad(0.0, std::numbers::pi);
  const PlanarFreeSpace space(world, min_gap_m);
  const int trials = space.empty() ? 0 : kTrialsPerBox * count;
  for (int trial = 0, boxes = 0; trial < trials && boxes < count; ++trial) {
    const Vector2d center = space.RandomPlace(rng);
    const double length_m = side_m(rng);
    const double width_m = side_m(rng);
    const double yaw = yaw_rad(rng);
    const double needed_m = 0.5 * std::hypot(length_m, width_m) + min_gap_m;
    if (world.Distance(center, needed_m) < needed_m) continue;
    std::vector<Segment> walls(world.walls().begin(), world.walls().end());
    const std::vector<Segment> box = BoxOutline(center, length_m, width_m, yaw);
    walls.insert(walls.end(), box.begin(), box.end());
    world = PlanarWorld(std::move(walls), {world.barriers().begin(), world.barriers().end()});
    ++boxes;
  }
  return world;
}

}  // namespace lcmslam
