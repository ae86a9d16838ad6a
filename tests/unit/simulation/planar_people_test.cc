#include "simulation/planar_people.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/planar_episode.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Person StandingPerson(const Vector2d& p) {
  return {.radius_m = 0.3, .motion = PlanarMotion(0, 1'000'000, Pose2(p, 0.0), {Vector3d::Zero()})};
}

TEST(Person, RaysMeetTheDiscsNearSide) {
  const Person person = StandingPerson({2.0, 0.0});
  for (int i = 0; i < 360; ++i) {
    const double heading = i * std::numbers::pi / 180.0;
    const Vector2d direction(std::cos(heading), std::sin(heading));
    const auto hit = person.CastRay({0.0, 0.0}, direction, 0);
    ASSERT_EQ(hit.has_value(), direction.x() > 0.0 && 2.0 * std::abs(direction.y()) <= 0.3) << i;
    if (!hit) continue;
    const Vector2d from_center = hit->range_m * direction - Vector2d(2.0, 0.0);
    EXPECT_NEAR(from_center.norm(), 0.3, 1e-12);
    EXPECT_TRUE(hit->normal.isApprox(from_center / 0.3));
    EXPECT_LT(hit->normal.dot(direction), 0.0);
  }
  EXPECT_FALSE(person.CastRay({2.1, 0.0}, {1.0, 0.0}, 0).has_value());  // from inside
}

TEST(Person, RaysMeetThePersonWhereItIsAtTheTime) {
  const Person person{.radius_m = 0.3,
                      .motion = PlanarMotion(0, 1'000'000, Pose2(2.0, 0.0, 0.0), {Vector3d(1.0, 0.0, 0.0)})};
  EXPECT_NEAR(person.CastRay({0.0, 0.0}, {1.0, 0.0}, 0)->range_m, 1.7, 1e-12);
  EXPECT_NEAR(person.CastRay({0.0, 0.0}, {1.0, 0.0}, 500'000)->range_m, 2.2, 1e-12);
}

TEST(Person, HidesTheWallBehind) {
  const PlanarWorld world({{{3.0, -5.0}, {3.0, 5.0}}});
  Rng rng(1);
  const auto at_origin = [](int64_t) { return Pose2(); };
  const SimulatedScan scan = SimulateScan(world, std::vector{StandingPerson({2.0, 0.0})}, at_origin, 0, {}, rng);
  EXPECT_FLOAT_EQ(scan.scan.beams[333].range_m, 1.7F);
  EXPECT_FLOAT_EQ(scan.scan.beams[433].range_m, static_cast<float>(3.0 / std::cos(scan.scan.beams[433].angle_rad)));
}

TEST(Person, TellsNothingOfThePose) {
  const PlanarWorld corridor({{{-50.0, -1.0}, {50.0, -1.0}}, {{-50.0, 1.0}, {50.0, 1.0}}});
  Rng rng(1);
  const auto at_origin = [](int64_t) { return Pose2(); };
  const PlanarLidarOptions options{.noise = RangeNoise::Low()};
  const std::vector people{StandingPerson({2.0, 0.0}), StandingPerson({3.0, 0.5})};
  EXPECT_FALSE(SimulateScan(corridor, people, at_origin, 0, options, rng).bound.has_value());
}

TEST(People, GiveWayToTheRobotAndStayOffWalls) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const PlanarEpisode episode = *PlanarEpisode::Create(Room5World(), {.seed = seed, .people = {.count = 3}});
    ASSERT_EQ(episode.people().size(), 3U);
    for (const Person& person : episode.people()) {
      double way_m = 0.0;
      for (int64_t utime = 1'000'000; utime <= 61'000'000; utime += 50'000) {
        const Vector2d p = person.motion.PoseAt(utime).translation();
        EXPECT_GE(episode.world().Distance(p), person.radius_m - 0.07);  // a step of 0.12 m may cut a corner
        EXPECT_GT((episode.motion().PoseAt(utime).translation() - p).norm(), 0.3);
        way_m += (person.motion.PoseAt(utime + 50'000).translation() - p).norm();
      }
      EXPECT_GT(way_m, 10.0);
    }
  }
}

TEST(People, OthersStayAsTheyWereWhenOneJoins) {
  const PlanarEpisode one = *PlanarEpisode::Create(Room5World(), {.people = {.count = 1}});
  const PlanarEpisode two = *PlanarEpisode::Create(Room5World(), {.people = {.count = 2}});
  for (int64_t utime = 1'000'000; utime <= 61'000'000; utime += 1'000'000) {
    EXPECT_EQ(one.people()[0].motion.PoseAt(utime).translation(), two.people()[0].motion.PoseAt(utime).translation());
    EXPECT_EQ(one.motion().PoseAt(utime).translation(), two.motion().PoseAt(utime).translation());
  }
}

TEST(People, NeedRoom) {
  const PlanarMotion robot(0, 1'000'000, Pose2(1.0, 1.0, 0.0), {Vector3d::Zero()});
  EXPECT_TRUE(SimulatePeople(Room5World(), robot, {.count = 2, .radius_m = 3.0}, 1).empty());
  EXPECT_TRUE(SimulatePeople(Room5World(), robot, {}, 1).empty());
}

TEST(People, ValidateNamesTheField) {
  EXPECT_EQ(PlanarPeopleOptions{}.Validate(), "");
  EXPECT_EQ(PlanarPeopleOptions{.radius_m = NAN}.Validate(), "radius_m: must be positive");
}

}  // namespace
}  // namespace lcmslam
