#include "simulation/planar_world.h"

#include <cmath>
#include <numbers>

#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>

#include "simulation/planar_worlds.h"
#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

double Uniform(Rng& rng, double low, double high) {
  return boost::random::uniform_real_distribution<double>(low, high)(rng);
}

Vector2d RandomPoint(Rng& rng, double half_side) {
  return {Uniform(rng, -half_side, half_side), Uniform(rng, -half_side, half_side)};
}

std::vector<Segment> RandomSegments(Rng& rng, int count) {
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Vector2d a = RandomPoint(rng, 10.0);
    segments.push_back({a, a + RandomPoint(rng, i % 2 == 0 ? 0.2 : 5.0)});
  }
  return segments;
}

// The definition, solved as 2x2 linear systems: origin + range * direction = a + fraction * (b - a).
double BruteForceRange(std::span<const Segment> segments, const Vector2d& origin, const Vector2d& direction) {
  double best = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    Eigen::Matrix2d system;
    system << direction, segment.a - segment.b;
    const Vector2d solution = system.inverse() * (segment.a - origin);
    if (solution.x() >= 0.0 && solution.y() >= 0.0 && solution.y() <= 1.0) best = std::min(best, solution.x());
  }
  return best;
}

TEST(PlanarWorld, CastsRaysLikeBruteForce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = MakeRng(seed, RandomStream::kObjects);
    const PlanarWorld world(RandomSegments(rng, 1 + static_cast<int>(10 * seed)));
    for (int i = 0; i < 500; ++i) {
      const Vector2d origin = RandomPoint(rng, 20.0);  // inside and outside the world's bounds
      const double angle = i % 10 == 0 ? (i / 10) * std::numbers::pi / 2.0 : Uniform(rng, -4.0, 4.0);
      const Vector2d direction(std::cos(angle), std::sin(angle));
      const double expected = BruteForceRange(world.walls(), origin, direction);
      const std::optional<SurfaceHit> hit = world.CastRay(origin, direction, 25.0);
      ASSERT_EQ(hit.has_value(), expected <= 25.0);
      if (hit) {
        EXPECT_NEAR(hit->range_m, expected, 1e-9);
      }
    }
  }
}

TEST(PlanarWorld, NormalFacesTheRay) {
  const PlanarWorld world({{{2.0, -1.0}, {2.0, 1.0}}});
  EXPECT_TRUE(world.CastRay({0.0, 0.0}, {1.0, 0.0}, 10.0)->normal.isApprox(Vector2d(-1.0, 0.0)));
  EXPECT_TRUE(world.CastRay({4.0, 0.0}, {-1.0, 0.0}, 10.0)->normal.isApprox(Vector2d(1.0, 0.0)));
}

TEST(PlanarWorld, SharedCornersLeaveNoGap) {
  for (const char* name : {"room5", "stdr10", "mocap5", "corridor"}) {
    const PlanarWorld world = *NamedPlanarWorld(name);
    const Vector2d inside = world.bounds().min() + Vector2d(0.7, 0.45);
    for (const Segment& wall : world.walls()) {
      const double range = (wall.a - inside).norm();
      const std::optional<SurfaceHit> hit = world.CastRay(inside, (wall.a - inside) / range, 100.0);
      ASSERT_TRUE(hit.has_value()) << name;
      EXPECT_LE(hit->range_m, range + 1e-9) << name;
    }
  }
}

TEST(PlanarWorld, RespectsTheMaximumRange) {
  const PlanarWorld world({{{2.0, -1.0}, {2.0, 1.0}}});
  EXPECT_TRUE(world.CastRay({0.0, 0.0}, {1.0, 0.0}, 2.0).has_value());
  EXPECT_FALSE(world.CastRay({0.0, 0.0}, {1.0, 0.0}, 1.999).has_value());
}

TEST(PlanarWorld, BarriersAreObstaclesThatRaysDoNotSee) {
  const PlanarWorld world({{{2.0, -1.0}, {2.0, 1.0}}}, {{{1.0, -1.0}, {1.0, 1.0}}});
  EXPECT_DOUBLE_EQ(world.CastRay({0.0, 0.0}, {1.0, 0.0}, 10.0)->range_m, 2.0);
  EXPECT_DOUBLE_EQ(world.Distance({0.0, 0.0}), 1.0);
}

double BruteForceDistance(std::span<const Segment> segments, const Vector2d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    const Eigen::ParametrizedLine<double, 2> line = Eigen::ParametrizedLine<double, 2>::Through(segment.a, segment.b);
    best = std::min({best, (p - segment.a).norm(), (p - segment.b).norm()});
    const double along = (p - segment.a).dot(line.direction());
    if (along > 0.0 && along < (segment.b - segment.a).norm()) best = std::min(best, line.distance(p));
  }
  return best;
}

TEST(PlanarWorld, MeasuresDistanceLikeBruteForce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = MakeRng(seed, RandomStream::kObjects);
    const PlanarWorld world(RandomSegments(rng, 1 + static_cast<int>(10 * seed)));
    for (int i = 0; i < 200; ++i) {
      const Vector2d p = RandomPoint(rng, 20.0);
      const double expected = BruteForceDistance(world.walls(), p);
      EXPECT_NEAR(world.Distance(p), expected, 1e-9);
      EXPECT_NEAR(world.Distance(p, 1.0), std::min(expected, 1.0), 1e-9);
    }
  }
}

TEST(PlanarWorld, EmptyWorldHasNothingToHit) {
  const PlanarWorld world({});
  EXPECT_FALSE(world.CastRay({0.0, 0.0}, {1.0, 0.0}, 10.0).has_value());
  EXPECT_EQ(world.Distance({0.0, 0.0}), std::numeric_limits<double>::infinity());
}

TEST(PlanarWorlds, UnknownNameIsNoWorld) { EXPECT_FALSE(NamedPlanarWorld("room6").has_value()); }

TEST(PlanarWorlds, RandomBoxesKeepTheirDistance) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const PlanarWorld world = WithRandomBoxes(Stdr10World(), 6, 0.7, seed);
    const size_t before = Stdr10World().walls().size();
    ASSERT_EQ(world.walls().size(), before + 4 * 6);
    for (size_t box = before; box < world.walls().size(); box += 4) {
      std::vector<Segment> others(world.walls().begin(), world.walls().end());
      others.erase(others.begin() + static_cast<long>(box), others.begin() + static_cast<long>(box) + 4);
      const PlanarWorld world_of_others(others);
      for (const Segment& side : world.walls().subspan(box, 4)) EXPECT_GE(world_of_others.Distance(side.a), 0.7);
    }
  }
}

TEST(PlanarWorlds, RandomBoxesEndWhereThereIsNoRoom) {
  EXPECT_LT(WithRandomBoxes(Room5World(), 1000, 0.5, 1).walls().size(), 200U);
}

}  // namespace
}  // namespace lcmslam
