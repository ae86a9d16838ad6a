#include "trajectory/map_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points RandomPoints(testing::Noise& noise, size_t count, double size_m) {
  Points points;
  for (size_t i = 0; i < count; ++i) {
    points.emplace_back(noise.Uniform(0.0, size_m), noise.Uniform(0.0, size_m), noise.Uniform(0.0, size_m));
  }
  return points;
}

double Nearest(const Eigen::Vector3d& p, const Points& others) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& other : others) nearest = std::min(nearest, (p - other).norm());
  return nearest;
}

TEST(CompareSurfaces, AgreesWithSearchOverAllPairs) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    testing::Noise noise(seed);
    const Points mapped = RandomPoints(noise, 200, 1.0), truth = RandomPoints(noise, 150, 1.0);
    const SurfaceQuality quality =
        CompareSurfaces(mapped, truth, {.completeness_m = {0.05, 0.1, 0.2}, .grid_m = 1e-6});  // no two in one cell
    std::vector<double> expected_m, missing_m;
    for (const Eigen::Vector3d& p : mapped) expected_m.push_back(Nearest(p, truth));
    for (const Eigen::Vector3d& p : truth) missing_m.push_back(Nearest(p, mapped));
    const Summary expected = Summarize(expected_m);
    EXPECT_NEAR(quality.distance_m.mean, expected.mean, 1e-12);
    EXPECT_NEAR(quality.distance_m.p95, expected.p95, 1e-12);
    ASSERT_EQ(quality.completeness.size(), 3u);
    for (const Completeness& c : quality.completeness) {
      const auto near = std::ranges::count_if(missing_m, [&](double d) { return d <= c.within_m; });
      EXPECT_DOUBLE_EQ(c.share, static_cast<double>(near) / 150.0);
    }
  }
}

// A wall of 4 m of which 3 m are mapped, 15 mm off; half of it was seen a hundred times as often.
TEST(CompareSurfaces, EveryPartOfTheSurfaceCountsAlike) {
  Points truth, mapped;
  for (int i = 0; i < 4000; ++i) truth.emplace_back(0.001 * i, 0.0, 0.0);
  for (int i = 0; i < 200'000; ++i) truth.emplace_back(0.00001 * i, 0.0, 0.0);
  for (int i = 0; i < 600; ++i) mapped.emplace_back(0.005 * i, 0.015, 0.0);
  const SurfaceQuality quality = CompareSurfaces(mapped, truth);
  EXPECT_NEAR(quality.distance_m.mean, 0.015, 1e-4);
  EXPECT_NEAR(quality.distance_m.p95, 0.015, 1e-4);
  EXPECT_NEAR(quality.completeness[0].share, 0.75, 0.01) << "and the last centimetres";
  EXPECT_NEAR(quality.completeness[2].share, 0.775, 0.01);
}

TEST(CompareSurfaces, NothingMappedAndNothingTrue) {
  const Points wall = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(CompareSurfaces({}, wall).distance_m.count, 0);
  EXPECT_EQ(CompareSurfaces({}, wall).completeness[2].share, 0.0);
  EXPECT_EQ(CompareSurfaces(wall, {}).distance_m.count, 0);
  EXPECT_TRUE(std::isnan(CompareSurfaces(wall, {}).completeness[0].share));
  EXPECT_EQ(CompareSurfaces(wall, wall).distance_m.max, 0.0);
}

TEST(WallThickness, IsTheNoiseAcrossTheWall) {
  for (const double angle_rad : {0.0, 0.3, 1.2}) {
    SCOPED_TRACE(angle_rad);
    testing::Noise noise(7);
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad)), across(-along.y(), along.x());
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 100'000; ++i) {
      points.push_back(noise.Uniform(-5.0, 5.0) * along + (0.26 + noise.Gauss(0.02)) * across);
    }
    const Summary thickness_m = WallThickness(points);
    EXPECT_GT(thickness_m.count, 10);
    EXPECT_NEAR(thickness_m.median, 0.02, 0.001);
  }
}

TEST(WallThickness, CornersAndSpecksAreNoWalls) {
  std::vector<Eigen::Vector2d> corner, speck;
  for (int i = 0; i < 400; ++i) {
    corner.emplace_back(0.001 * i + 0.05, 0.05);
    corner.emplace_back(0.05, 0.001 * i + 0.05);
  }
  for (int i = 0; i < 50; ++i) speck.emplace_back(0.001 * i, 0.2);
  EXPECT_EQ(WallThickness(corner).count, 0);
  EXPECT_EQ(WallThickness(speck).count, 0);
  EXPECT_EQ(WallThickness({}).count, 0);
}

TEST(MapQualityOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(SurfaceQualityOptions{}.Validate(), "");
  EXPECT_EQ(SurfaceQualityOptions{.grid_m = 0.0}.Validate(), "grid_m: must be positive");
  EXPECT_EQ(SurfaceQualityOptions{.completeness_m = {-1.0}}.Validate(), "completeness_m: must be positive");
  EXPECT_EQ(WallThicknessOptions{}.Validate(), "");
  EXPECT_EQ(WallThicknessOptions{.min_points = 1}.Validate(), "min_points: must be 3 or more");
  EXPECT_EQ(WallThicknessOptions{.cell_m = std::nan("")}.Validate(), "cell_m: must be positive");
}

}  // namespace
}  // namespace lcmslam
