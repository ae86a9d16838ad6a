#include "sdf2d/fusion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "sdf2d/sdf_reader.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

constexpr double kCell_m = 0.05;

SurfaceLine Line(const Vector2d& begin, const Vector2d& end, double sigma_m = 0.002) {
  const Vector2d along = (end - begin).normalized();
  SurfaceLine line;
  line.normal = Vector2d(-along.y(), along.x());
  line.begin = begin;
  line.end = end;
  line.variance = {sigma_m * sigma_m, 0.0, 0.0};
  line.beam_sigma_m = sigma_m;
  return line;
}

ScanField FieldOf(const std::vector<SurfaceLine>& lines, const FusionOptions& options = {}) {
  ScanField field;
  field.Rasterize(lines, Pose2(), kCell_m, options);
  return field;
}

// Lines in all directions, at random.
TEST(ScanField, EveryVertexOfTheBandAndNoOtherWithItsPerpendicularDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> metres(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const SurfaceLine line = Line({metres(random), metres(random)}, {metres(random), metres(random)});
    const FusionOptions options;
    const ScanField field = FieldOf({line}, options);
    std::map<std::pair<int, int>, double> written;
    for (const VertexMeasurement& m : field.measurements()) written[{m.x, m.y}] = m.distance_m;
    const Vector2d along = (line.end - line.begin).normalized();
    const double length = (line.end - line.begin).norm();
    for (int y = -30; y <= 30; ++y) {
      for (int x = -30; x <= 30; ++x) {
        const Vector2d from_begin = kCell_m * Vector2d(x, y) - line.begin;
        const double distance = line.normal.dot(from_begin), t = along.dot(from_begin);
        const double inside = std::min({options.band_cells * kCell_m - std::abs(distance),
                                        t + options.end_cells * kCell_m, length + options.end_cells * kCell_m - t});
        if (std::abs(inside) < 1e-9) continue;
        ASSERT_EQ(written.contains({x, y}), inside > 0.0) << x << " " << y;
        if (inside > 0.0) {
          EXPECT_NEAR((written[{x, y}]), distance, 1e-6);
        }
      }
    }
  }
}

TEST(ScanField, NearerSurfaceSpeaksAtACorner) {
  // A room's corner at the origin; the free side is x > 0, y > 0.
  const std::vector<SurfaceLine> lines = {Line({0.0, 1.0}, {0.0, 0.0}), Line({0.0, 0.0}, {1.0, 0.0})};
  const ScanField field = FieldOf(lines);
  for (const VertexMeasurement& m : field.measurements()) {
    if (m.x <= 0 || m.y <= 0) continue;
    EXPECT_NEAR(m.distance_m, kCell_m * std::min(m.x, m.y), 1e-6) << m.x << " " << m.y;
  }
}

TEST(ScanField, HoldsMoreThanItStartsWith) {
  std::vector<SurfaceLine> lines;
  for (int i = 0; i < 40; ++i) lines.push_back(Line({0.0, i}, {10.0, i}));
  const ScanField field = FieldOf(lines);
  EXPECT_GT(field.measurements().size(), 20000U);
  std::map<std::tuple<int, int, int>, int> seen;
  for (const VertexMeasurement& m : field.measurements()) EXPECT_EQ((++seen[{m.x, m.y, m.sheet}]), 1);
}

TEST(ScanField, NoLinesNoField) { EXPECT_TRUE(FieldOf({}).measurements().empty()); }

TEST(Fuse, IsTheInformationWeightedMean) {
  SdfMap map(kCell_m);
  const FusionOptions options;
  double sum = 0.0, weights = 0.0;
  for (const auto& [height, sigma] : {std::pair{0.010, 0.01}, {0.004, 0.003}, {-0.006, 0.02}}) {
    const ScanField field = FieldOf({Line({-0.5, height}, {0.5, height}, sigma)}, options);
    for (const VertexMeasurement& m : field.measurements()) {
      if (m.x != 0 || m.y != 0) continue;
      sum += m.information * m.distance_m;
      weights += m.information;
    }
    Fuse(field, options, &map);
  }
  const SdfTile::Vertex vertex = map.Find(0, 0)->Nearest(0);
  EXPECT_NEAR(vertex.distance_m, sum / weights, 1e-7);
  EXPECT_NEAR(vertex.information / weights, 1.0, 1e-5);
}

TEST(Fuse, ThinWallKeepsBothSides) {
  SdfMap map(kCell_m);
  const SurfaceLine above = Line({-1.0, 0.01}, {1.0, 0.01});  // faces up
  const SurfaceLine below = Line({1.0, -0.01}, {-1.0, -0.01});
  for (int i = 0; i < 5; ++i) {
    for (const SurfaceLine& line : {above, below}) Fuse(FieldOf({line}), {}, &map);
  }
  SdfReader reader(map);
  EXPECT_NEAR(reader.Facing({0.3, 0.01}, {0.2, -1.0}).distance_m, 0.0, 1e-6);
  EXPECT_NEAR(reader.Facing({0.3, -0.01}, {0.2, 1.0}).distance_m, 0.0, 1e-6);
}

TEST(Fuse, MovedWallIsLearnt) {
  SdfMap map(kCell_m);
  for (int i = 0; i < 100; ++i) Fuse(FieldOf({Line({-1.0, 0.0}, {1.0, 0.0})}), {}, &map);
  for (int i = 0; i < 20; ++i) Fuse(FieldOf({Line({-1.0, 0.1}, {1.0, 0.1})}), {}, &map);
  SdfReader reader(map);
  EXPECT_NEAR(reader.Facing({0.3, 0.1}, {0.0, -1.0}).distance_m, 0.0, 0.005);
}

TEST(Carve, RemovesWhatBeamsPassThrough) {
  const FusionOptions options{.carve_every = 1};
  const NoiseModel noise({.estimate = false});
  for (const double phase_m : {0.0, 0.01, 0.02, 0.03, 0.04}) {
    SCOPED_TRACE(phase_m);
    SdfMap map(kCell_m);
    Fuse(FieldOf({Line({-0.3, 1.0 + phase_m}, {0.3, 1.0 + phase_m})}, options), options, &map);  // faces up
    Fuse(FieldOf({Line({0.3, -1.0}, {-0.3, -1.0})}, options), options, &map);                    // not in the way
    std::vector<Vector2d> ends;
    for (double x = -0.6; x <= 0.6; x += 0.02) ends.emplace_back(x, 0.0);
    ASSERT_TRUE(SdfReader(map).Facing({0.01, 1.0 + phase_m}, {0.0, -1.0}).IsKnown());
    for (int scan = 0; scan < 60; ++scan) Carve(ends, {0.0, 3.0}, Pose2(), noise, 0, options, &map);
    EXPECT_FALSE(SdfReader(map).Facing({0.01, 1.0 + phase_m}, {0.0, -1.0}).IsKnown());
    EXPECT_TRUE(SdfReader(map).Facing({0.01, -1.0}, {0.0, 1.0}).IsKnown());
  }
}

TEST(Carve, LeavesTheWallThatStoppedTheBeam) {
  const FusionOptions options{.carve_every = 1};
  SdfMap map(kCell_m);
  Fuse(FieldOf({Line({-1.0, 0.0}, {1.0, 0.0})}, options), options, &map);
  const double information = map.Find(0, 0)->Nearest(5).information;
  std::vector<Vector2d> ends;
  for (double x = -0.9; x <= 0.9; x += 0.02) ends.emplace_back(x, 0.0);
  for (int scan = 0; scan < 20; ++scan) Carve(ends, {0.0, 2.0}, Pose2(), NoiseModel({}), 0, options, &map);
  EXPECT_EQ(map.Find(0, 0)->Nearest(5).information, information);
  EXPECT_GT(map.Find(0, 0)->seen_through[SdfTile::IndexOf(0, 20)], 0);
}

TEST(Carve, LengthZeroAndNoBeams) {
  SdfMap map(kCell_m);
  Carve({}, {0.0, 0.0}, Pose2(), NoiseModel({}), 0, {}, &map);
  const std::vector<Vector2d> at_lidar(3, Vector2d::Zero());
  Carve(at_lidar, {0.0, 0.0}, Pose2(), NoiseModel({}), 0, {.carve_every = 1}, &map);
  EXPECT_TRUE(map.empty());
}

TEST(Coarsen, KeepsTheSurfaces) {
  SdfMap fine(kCell_m);
  Fuse(FieldOf({Line({-2.0, 0.13}, {2.0, 0.13}), Line({2.0, 0.13}, {2.0, 2.0})}), {}, &fine);
  const SdfMap coarse = Coarsen(fine, 0.2, {});
  SdfReader reader(coarse);
  for (double x = -1.8; x < 1.5; x += 0.07) {
    EXPECT_NEAR(reader.Facing({x, 0.2}, {0.1, -1.0}).distance_m, 0.07, 1e-3) << x;
  }
  EXPECT_TRUE(Coarsen(SdfMap(kCell_m), 0.2, {}).empty());
}

}  // namespace
}  // namespace lcmslam::sdf2d
