#include "sdf2d/sdf_reader.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

constexpr double kCell_m = 0.05;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void SetVertex(SdfMap& map, int sheet, int x, int y, double distance_m) {
  SdfTile& tile = map.Touch(x >> SdfTile::kShift, y >> SdfTile::kShift);
  tile.sheets[sheet].distance_m[SdfTile::IndexOf(x, y)] = static_cast<float>(distance_m);
  tile.sheets[sheet].information[SdfTile::IndexOf(x, y)] = 1.0F;
}

// Random values on the vertices around the corner where four tiles meet.
SdfMap RandomMap(std::mt19937_64& random) {
  std::uniform_real_distribution<double> distance(-0.1, 0.1);
  SdfMap map(kCell_m);
  for (int y = -6; y <= 6; ++y) {
    for (int x = -6; x <= 6; ++x) SetVertex(map, 0, x, y, distance(random));
  }
  return map;
}

double VertexOf(const SdfMap& map, int x, int y) {
  const SdfTile* tile = map.Find(x >> SdfTile::kShift, y >> SdfTile::kShift);
  return tile == nullptr ? kNan : tile->sheets[0].distance_m[SdfTile::IndexOf(x, y)];
}

// The definition: a sum over all vertices of value times hat functions.
double BruteForce(const SdfMap& map, const Vector2d& p) {
  double sum = 0.0;
  for (int y = -6; y <= 6; ++y) {
    for (int x = -6; x <= 6; ++x) {
      const double hat_x = std::max(0.0, 1.0 - std::abs(p.x() / kCell_m - x));
      const double hat_y = std::max(0.0, 1.0 - std::abs(p.y() / kCell_m - y));
      sum += VertexOf(map, x, y) * hat_x * hat_y;
    }
  }
  return sum;
}

TEST(SdfReader, InterpolatesBilinearlyAcrossTiles) {
  std::mt19937_64 random(1);
  const SdfMap map = RandomMap(random);
  SdfReader reader(map);
  std::uniform_real_distribution<double> metres(-0.29, 0.29);
  for (int i = 0; i < 2000; ++i) {
    const Vector2d p(metres(random), metres(random));
    const SdfReader::Sample sample = reader.At(0, p);
    ASSERT_TRUE(sample.IsKnown());
    EXPECT_NEAR(sample.distance_m, BruteForce(map, p), 1e-12);
  }
}

TEST(SdfReader, GradientIsTheDerivativeOfTheInterpolant) {
  std::mt19937_64 random(2);
  const SdfMap map = RandomMap(random);
  SdfReader reader(map);
  std::uniform_real_distribution<double> metres(-0.28, 0.28);
  constexpr double kStep_m = 1e-7;
  for (int i = 0; i < 2000; ++i) {
    const Vector2d p(metres(random), metres(random));
    const Vector2d in_cell = p / kCell_m - (p / kCell_m).array().floor().matrix();
    if (in_cell.minCoeff() < 1e-4 || in_cell.maxCoeff() > 1.0 - 1e-4) continue;  // a kink
    const Vector2d dx(kStep_m, 0.0), dy(0.0, kStep_m);
    const Vector2d numeric(BruteForce(map, p + dx) - BruteForce(map, p - dx),
                           BruteForce(map, p + dy) - BruteForce(map, p - dy));
    EXPECT_TRUE(reader.At(0, p).gradient.isApprox(numeric / (2.0 * kStep_m), 1e-5)) << p.transpose();
  }
}

TEST(SdfReader, UnknownWhereAnyCornerIs) {
  SdfMap map(kCell_m);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}}) SetVertex(map, 0, x, y, 0.01);
  SdfReader reader(map);
  EXPECT_FALSE(reader.At(0, {0.02, 0.02}).IsKnown());
  EXPECT_FALSE(reader.At(1, {0.02, 0.02}).IsKnown());
  EXPECT_FALSE(reader.At(0, {100.0, 100.0}).IsKnown());
  SetVertex(map, 0, 1, 1, 0.01);
  EXPECT_TRUE(SdfReader(map).At(0, {0.02, 0.02}).IsKnown());
}

TEST(SdfReader, NonFiniteAndFarPointsAreUnknown) {
  std::mt19937_64 random(3);
  const SdfMap map = RandomMap(random);
  SdfReader reader(map);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), -1e300, 1e12}) {
    EXPECT_FALSE(reader.At(0, {bad, 0.0}).IsKnown()) << bad;
    EXPECT_FALSE(reader.Facing({0.0, bad}, {1.0, 0.0}).IsKnown()) << bad;
  }
  EXPECT_FALSE(SdfReader(SdfMap(kCell_m)).At(0, {0.0, 0.0}).IsKnown());
}

TEST(SdfReader, BeamSeesTheSideThatFacesIt) {
  SdfMap map(kCell_m);  // a wall without thickness along x = 0.02, seen from both sides
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      SetVertex(map, 0, x, y, x * kCell_m - 0.02);
      SetVertex(map, 1, x, y, 0.02 - x * kCell_m);
    }
  }
  SdfReader reader(map);
  EXPECT_NEAR(reader.Facing({0.03, 0.01}, {-1.0, 0.3}).distance_m, 0.01, 1e-6);
  EXPECT_NEAR(reader.Facing({0.03, 0.01}, {1.0, 0.3}).distance_m, -0.01, 1e-6);
  EXPECT_FALSE(reader.Facing({0.03, 0.01}, {0.0, 1.0}).IsKnown()) << "a beam along the wall";
}

}  // namespace
}  // namespace lcmslam::sdf2d
