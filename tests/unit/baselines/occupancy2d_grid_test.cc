#include "baselines/occupancy2d_grid.h"

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace lcmslam::occupancy2d {
namespace {

using Eigen::Vector2d;
using Gradient = LogOddsGrid::Gradient;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

const double kFree = std::log(0.4 / 0.6);
const double kOccupied = std::log(0.9 / 0.1);

std::vector<GridCell> Line(const GridCell& from, const GridCell& to) {
  std::vector<GridCell> cells;
  VisitLine(from, to, [&](const GridCell& cell) { cells.push_back(cell); });
  return cells;
}

TEST(VisitLine, StaysWithinHalfACellOfTheLine) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(-40, 40);
  for (int i = 0; i < 2000; ++i) {
    const GridCell from{coordinate(random), coordinate(random)}, to{coordinate(random), coordinate(random)};
    SCOPED_TRACE(testing::Message() << from.x << " " << from.y << " to " << to.x << " " << to.y);
    const std::vector<GridCell> cells = Line(from, to);
    const int length = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    ASSERT_EQ(cells.size(), static_cast<size_t>(length));
    for (int k = 0; k < length; ++k) {
      const double along = static_cast<double>(k) / length;
      EXPECT_LE(std::abs(cells[k].x - (from.x + along * (to.x - from.x))), 0.5 + 1e-9);
      EXPECT_LE(std::abs(cells[k].y - (from.y + along * (to.y - from.y))), 0.5 + 1e-9);
    }
  }
}

TEST(VisitLine, NothingWithinOneCell) { EXPECT_TRUE(Line({3, -2}, {3, -2}).empty()); }

TEST(LogOddsGrid, ABeamFreesWhatItCrossesAndFillsWhereItEnds) {
  LogOddsGrid grid({.cell_m = 0.1});
  grid.Insert({0.0, 0.0}, std::vector<Vector2d>{{0.5, 0.0}});
  for (int x = 0; x < 5; ++x) EXPECT_NEAR(grid.LogOdds({x, 0}), kFree, 1e-6) << x;
  EXPECT_NEAR(grid.LogOdds({5, 0}), kOccupied, 1e-6);
  EXPECT_EQ(grid.LogOdds({6, 0}), 0.0);
  EXPECT_EQ(grid.LogOdds({2, 1}), 0.0);
}

TEST(LogOddsGrid, EachCellChangesOnceAScanAndOccupiedBeatsFree) {
  LogOddsGrid grid({.cell_m = 0.1});
  const std::vector<Vector2d> ends = {{0.5, 0.0}, {0.3, 0.0}, {0.31, 0.01}, {0.5, 0.0}};  // the first crosses the rest
  for (int scan = 1; scan <= 3; ++scan) {
    grid.Insert({0.0, 0.0}, ends);
    EXPECT_NEAR(grid.LogOdds({3, 0}), scan * kOccupied, 1e-5);
    EXPECT_NEAR(grid.LogOdds({5, 0}), scan * kOccupied, 1e-5);
    EXPECT_NEAR(grid.LogOdds({1, 0}), scan * kFree, 1e-5);
  }
}

TEST(LogOddsGrid, GrowsLikeAMapWithoutBounds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-15.0, 15.0), range(-2.0, 2.0);
  LogOddsGrid grid({.cell_m = 0.1});
  std::map<std::pair<int, int>, double> oracle;
  for (int scan = 0; scan < 60; ++scan) {
    const Vector2d sensor(place(random), place(random));
    std::vector<Vector2d> ends(20);
    for (Vector2d& end : ends) end = sensor + Vector2d(range(random), range(random));
    grid.Insert(sensor, ends);
    std::set<std::pair<int, int>> occupied, free;
    for (const Vector2d& end : ends) {
      const GridCell cell = grid.CellOf(end);
      occupied.insert({cell.x, cell.y});
      for (const GridCell& crossed : Line(grid.CellOf(sensor), cell)) free.insert({crossed.x, crossed.y});
    }
    for (const auto& cell : occupied) oracle[cell] += kOccupied, free.erase(cell);
    for (const auto& cell : free) oracle[cell] += kFree;
  }
  for (int x = -180; x <= 180; ++x) {
    for (int y = -180; y <= 180; ++y) {
      const auto at = oracle.find({x, y});
      ASSERT_NEAR(grid.LogOdds({x, y}), at == oracle.end() ? 0.0 : at->second, 1e-4) << x << " " << y;
    }
  }
}

LogOddsGrid RandomGrid() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  LogOddsGrid grid({.cell_m = 0.1});
  for (int scan = 0; scan < 4; ++scan) {
    std::vector<Vector2d> ends(100);
    for (Vector2d& end : ends) end = {coordinate(random), coordinate(random)};
    grid.Insert({coordinate(random), coordinate(random)}, ends);
  }
  return grid;
}

double ProbabilityOf(const LogOddsGrid& grid, int x, int y) { return 1.0 / (1.0 + std::exp(-grid.LogOdds({x, y}))); }

TEST(LogOddsGrid, InterpolatesBetweenCellCentres) {
  const LogOddsGrid grid = RandomGrid();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-0.95, 0.85), fraction(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const int x = static_cast<int>(10.0 * coordinate(random)), y = static_cast<int>(10.0 * coordinate(random));
    const double u = fraction(random), v = fraction(random);
    const double m00 = ProbabilityOf(grid, x, y), m10 = ProbabilityOf(grid, x + 1, y);
    const double m01 = ProbabilityOf(grid, x, y + 1), m11 = ProbabilityOf(grid, x + 1, y + 1);
    const auto exact = grid.At(Vector2d(x + u, y + v) * 0.1, Gradient::kExact);
    const auto released = grid.At(Vector2d(x + u, y + v) * 0.1, Gradient::kReleased);
    EXPECT_NEAR(exact.probability, (1 - v) * ((1 - u) * m00 + u * m10) + v * ((1 - u) * m01 + u * m11), 1e-6);
    EXPECT_EQ(released.probability, exact.probability);
    EXPECT_NEAR(exact.gradient.x(), ((1 - v) * (m10 - m00) + v * (m11 - m01)) / 0.1, 1e-5);
    EXPECT_NEAR(exact.gradient.y(), ((1 - u) * (m01 - m00) + u * (m11 - m10)) / 0.1, 1e-5);
    EXPECT_NEAR(released.gradient.x(), ((1 - u) * (m10 - m00) + u * (m11 - m01)) / 0.1, 1e-5);
    EXPECT_NEAR(released.gradient.y(), ((1 - v) * (m01 - m00) + v * (m11 - m10)) / 0.1, 1e-5);
  }
}

TEST(LogOddsGrid, ExactGradientIsTheNumericDerivative) {
  const LogOddsGrid grid = RandomGrid();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-0.9, 0.9);
  constexpr double kStep_m = 1e-6;
  const auto probability = [&](double x, double y) { return grid.At({x, y}, Gradient::kExact).probability; };
  for (int i = 0; i < 500; ++i) {
    const double x = coordinate(random), y = coordinate(random);
    const auto near_seam = [&](double value) { return std::abs(std::remainder(value, 0.1)) < 2.0 * kStep_m; };
    if (near_seam(x) || near_seam(y)) continue;
    const Vector2d numeric(probability(x + kStep_m, y) - probability(x - kStep_m, y),
                           probability(x, y + kStep_m) - probability(x, y - kStep_m));
    EXPECT_LT((grid.At({x, y}, Gradient::kExact).gradient - numeric / (2.0 * kStep_m)).norm(), 1e-6);
  }
}

TEST(LogOddsGrid, UnknownIsFlat) {
  const LogOddsGrid grid = RandomGrid();
  for (const Vector2d& p : {Vector2d(50.0, 0.0), Vector2d(-1e9, 1e9), Vector2d(kNan, 0.0), Vector2d(0.0, kInf)}) {
    EXPECT_EQ(grid.At(p, Gradient::kExact).probability, 0.5);
    EXPECT_EQ(grid.At(p, Gradient::kExact).gradient, Vector2d::Zero());
  }
  EXPECT_EQ(LogOddsGrid({}).At({0.0, 0.0}, Gradient::kExact).probability, 0.5);
}

TEST(LogOddsGrid, LeavesOutWhatIsBeyondItsExtent) {
  LogOddsGrid grid({.cell_m = 0.1, .max_extent_m = 2.0});
  grid.Insert({2.1, 0.0}, std::vector<Vector2d>{{0.0, 0.0}});
  grid.Insert({kNan, 0.0}, std::vector<Vector2d>{{0.0, 0.0}});
  EXPECT_EQ(grid.ToOccupancyGrid().cells.size(), 0U);
  grid.Insert({0.0, 0.0}, std::vector<Vector2d>{{0.0, 2.1}, {1e12, 0.0}, {kNan, 1.0}, {0.0, -kInf}, {0.0, -1.0}});
  EXPECT_EQ(grid.LogOdds({0, 1}), 0.0) << "crossed only by beams left out";
  EXPECT_EQ(grid.LogOdds({1, 0}), 0.0);
  EXPECT_NEAR(grid.LogOdds({0, -10}), kOccupied, 1e-6);
}

TEST(LogOddsGrid, StaysFiniteForEver) {
  LogOddsGrid grid({.cell_m = 0.1});
  for (int scan = 0; scan < 1000; ++scan) grid.Insert({0.0, 0.0}, std::vector<Vector2d>{{0.5, 0.0}});
  EXPECT_EQ(grid.LogOdds({5, 0}), 50.0);
  EXPECT_EQ(grid.LogOdds({1, 0}), -50.0);
  EXPECT_NEAR(grid.At({0.5, 0.0}, Gradient::kExact).probability, 1.0, 1e-6);
}

TEST(LogOddsGrid, DrawsTheSmallestGridOfWhatWasSeen) {
  LogOddsGrid grid({.cell_m = 0.1});
  grid.Insert({-0.2, 0.3}, std::vector<Vector2d>{{0.2, 0.3}, {-0.2, 0.5}});
  const OccupancyGrid drawn = grid.ToOccupancyGrid();
  EXPECT_EQ(drawn.width, 5);
  EXPECT_EQ(drawn.height, 3);
  EXPECT_LT((drawn.origin_m - Vector2d(-0.25, 0.25)).norm(), 1e-12);
  EXPECT_EQ(drawn.cell_m, 0.1);
  for (int row = 0; row < drawn.height; ++row) {
    for (int column = 0; column < drawn.width; ++column) {
      EXPECT_EQ(drawn.At(column, row), QuantizeLogOdds(grid.LogOdds({column - 2, row + 3})));
    }
  }
}

TEST(LogOddsGrid, ValidateNamesTheField) {
  EXPECT_EQ(LogOddsGrid::Options{}.Validate(), "");
  EXPECT_EQ((LogOddsGrid::Options{.cell_m = kNan}.Validate()), "cell_m: must be positive");
  EXPECT_EQ((LogOddsGrid::Options{.probability_free = 0.5}.Validate()), "probability_free: must be in (0, 0.5)");
  EXPECT_EQ((LogOddsGrid::Options{.probability_occupied = 1.0}.Validate()),
            "probability_occupied: must be in (0.5, 1)");
  EXPECT_EQ((LogOddsGrid::Options{.max_extent_m = kInf}.Validate()), "max_extent_m: must be at most 10000 cells");
}

}  // namespace
}  // namespace lcmslam::occupancy2d
