#include "sdf2d/contour.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace lcmslam::sdf2d {
namespace {

// Vertices within `band_m` of the zero line of `distance` know it.
SdfMap MapOf(const std::function<double(const Eigen::Vector2d&)>& distance, int sheet = 0, double band_m = 0.2) {
  SdfMap map(0.05);
  for (int32_t y = -60; y <= 60; ++y) {
    for (int32_t x = -60; x <= 60; ++x) {
      const double d = distance(map.cell_m() * Eigen::Vector2d(x, y));
      if (std::abs(d) > band_m) continue;
      SdfTile& tile = map.Touch(x >> SdfTile::kShift, y >> SdfTile::kShift);
      tile.sheets[sheet].distance_m[SdfTile::IndexOf(x, y)] = static_cast<float>(d);
    }
  }
  return map;
}

TEST(Contour, CircleIsRoundAndWhole) {
  const double radius_m = 1.7, spacing_m = 0.01;
  for (const int sheet : {0, 1}) {
    const auto points = Contour(MapOf([&](const auto& p) { return p.norm() - radius_m; }, sheet), spacing_m);
    std::vector<double> angles;
    for (const Eigen::Vector2d& p : points) {
      EXPECT_NEAR(p.norm(), radius_m, 0.001);  // a chord of one cell is that far inside
      angles.push_back(std::atan2(p.y(), p.x()));
    }
    std::ranges::sort(angles);
    ASSERT_GT(angles.size(), 1000u);
    for (size_t i = 1; i < angles.size(); ++i) EXPECT_LT((angles[i] - angles[i - 1]) * radius_m, 1.01 * spacing_m);
  }
}

TEST(Contour, StraightWallIsExact) {
  const Eigen::Vector2d normal(0.6, 0.8);
  const auto points = Contour(MapOf([&](const auto& p) { return p.dot(normal) - 0.33; }), 0.02);
  ASSERT_GT(points.size(), 200u);
  for (const Eigen::Vector2d& p : points) EXPECT_NEAR(p.dot(normal), 0.33, 1e-6);
}

// Two corners meet in one cell: the lines keep to their own corner. Chords of its hyperbolas run where the distance is
// negative; lines that joined the corners would run where it is positive, by up to 2.4 mm.
TEST(Contour, SaddleKeepsCornersApart) {
  const auto saddle = [](const Eigen::Vector2d& p) { return (p.x() - 0.023) * (p.y() - 0.019) / 0.05 + 0.0005; };
  const auto points = Contour(MapOf(saddle), 0.01);
  ASSERT_GT(points.size(), 100u);
  for (const Eigen::Vector2d& p : points) {
    EXPECT_LT(saddle(p), 1e-6) << p.transpose();
    EXPECT_GT(saddle(p), -0.004) << p.transpose();
  }
}

TEST(Contour, NothingKnownNoSurface) {
  EXPECT_TRUE(Contour(SdfMap(0.05), 0.01).empty());
  EXPECT_TRUE(Contour(MapOf([](const auto&) { return 0.1; }), 0.01).empty()) << "no change of sign";
}

}  // namespace
}  // namespace lcmslam::sdf2d
