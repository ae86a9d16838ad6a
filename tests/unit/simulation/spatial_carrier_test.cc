#include "simulation/spatial_carrier.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/spatial_worlds.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

struct Extremes {
  double way_m = 0.0;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  double clearance_m = 10.0;
  double tilt_rad = 0.0;
};

Extremes Survey(const SpatialWorld& world, const SpatialMotion& motion) {
  constexpr double kStep_s = 0.02;
  Extremes e;
  for (double t_s = 0.0; t_s < motion.duration_s(); t_s += kStep_s) {
    const BodyState body = motion.StateAt(t_s);
    e.way_m += kStep_s * body.velocity_mps.norm();
    e.speed_mps = std::max(e.speed_mps, body.velocity_mps.norm());
    e.turn_rate_radps = std::max(e.turn_rate_radps, body.angular_velocity_radps.norm());
    e.clearance_m = std::min(e.clearance_m, world.Distance(body.T_world_body.translation, 10.0));
    const double upright = (body.T_world_body.rotation * Vector3d::UnitZ()).z();
    e.tilt_rad = std::max(e.tilt_rad, std::acos(std::min(upright, 1.0)));
  }
  return e;
}

TEST(CarryAround, KeepsItsLimits) {
  for (const std::string_view name : {"hall10", "bare_room", "corridor40"}) {
    const SpatialWorld world = *NamedSpatialWorld(name);
    for (uint64_t seed = 0; seed < 8; ++seed) {
      SpatialCarrierOptions options;
      options.carrier = seed % 2 == 0 ? SpatialCarrier::kHandheld : SpatialCarrier::kMulticopter;
      options.max_turn_rate_radps = seed < 4 ? 1.0 : 2.0;
      SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(seed));
      const std::optional<SpatialMotion> motion = CarryAround(world, 60.0, options, seed);
      ASSERT_TRUE(motion.has_value());
      ASSERT_GE(motion->duration_s(), 60.0);
      const Extremes e = Survey(world, *motion);
      EXPECT_LE(e.speed_mps, options.max_speed_mps);
      EXPECT_GE(e.speed_mps, 0.85 * options.max_speed_mps);
      EXPECT_LE(e.turn_rate_radps, options.max_turn_rate_radps);
      EXPECT_GE(e.turn_rate_radps, 0.6 * options.max_turn_rate_radps);
      EXPECT_GE(e.clearance_m, options.clearance_m);
      EXPECT_LE(e.tilt_rad, std::sqrt(2.0) * options.max_tilt_rad);
      EXPECT_GT(e.way_m, 36.0);
      EXPECT_LT(e.way_m, 50.0);
    }
  }
}

// The hall's window is wide enough to fly through.
TEST(CarryAround, StaysInside) {
  const SpatialWorld world = Hall10World();
  const Eigen::AlignedBox3d bounds(Vector3d(0.0, 0.0, 0.0), Vector3d(10.3, 8.0, 3.0));  // to the window's outer edge
  for (const uint64_t seed : {1, 5, 24, 27}) {
    const SpatialMotion motion = *CarryAround(world, 1800.0, {}, seed);
    for (double t_s = 0.0; t_s < motion.duration_s(); t_s += 0.5) {
      ASSERT_TRUE(bounds.contains(motion.PoseAt(t_s).translation)) << "seed " << seed << ", " << t_s << " s";
    }
  }
}

TEST(CarryAround, RestsLevelAndThenMoves) {
  const SpatialWorld world = BareRoomWorld();
  const SpatialMotion motion = *CarryAround(world, 10.0, {.rest_s = 1.5}, 3);
  const Pose3 start = motion.PoseAt(0.0);
  for (const double t_s : {0.0, 0.7, 1.5}) {
    const BodyState body = motion.StateAt(t_s);
    EXPECT_LT((body.T_world_body.translation - start.translation).norm(), 1e-12);
    EXPECT_LT(AngleBetween(body.T_world_body.rotation, start.rotation), 1e-7);
    EXPECT_LT(body.velocity_mps.norm() + body.angular_velocity_radps.norm(), 1e-12);
  }
  EXPECT_NEAR((start.rotation * Vector3d::UnitZ()).z(), 1.0, 1e-12);
  EXPECT_GT(motion.StateAt(3.5).velocity_mps.norm(), 0.3);
}

TEST(CarryAround, StartsInMotion) {
  const SpatialWorld world = BareRoomWorld();
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const SpatialMotion motion = *CarryAround(world, 10.0, {.start_in_motion = true}, seed);
    EXPECT_GT(motion.StateAt(0.0).velocity_mps.norm(), 0.3) << seed;
  }
}

// A multicopter leans into its acceleration: its thrust axis follows acceleration and weight.
TEST(CarryAround, MulticopterTiltsToAccelerate) {
  const SpatialWorld world = Hall10World();
  const SpatialMotion motion = *CarryAround(world, 60.0, {.carrier = SpatialCarrier::kMulticopter}, 1);
  double agreement = 0.0;
  for (double t_s = 3.0; t_s < 60.0; t_s += 0.1) {
    const BodyState body = motion.StateAt(t_s);
    const Vector3d lean = body.T_world_body.rotation * Vector3d::UnitZ();
    agreement += lean.head<2>().dot(body.acceleration_mps2.head<2>());
  }
  EXPECT_GT(agreement, 0.0);
}

TEST(CarryAround, SeedDecides) {
  const SpatialWorld world = BareRoomWorld();
  const auto place = [&](uint64_t seed) { return CarryAround(world, 10.0, {}, seed)->PoseAt(8.0).translation; };
  EXPECT_EQ(place(1), place(1));
  EXPECT_NE(place(1), place(2));
}

TEST(CarryAround, NoneWithoutRoom) {
  const SpatialWorld world = BareRoomWorld();
  EXPECT_FALSE(CarryAround(world, 10.0, {.clearance_m = 2.0}, 1).has_value());
  EXPECT_FALSE(CarryAround(world, 10.0, {.min_height_m = 5.0, .max_height_m = 6.0}, 1).has_value()) << "over the roof";
}

TEST(SpatialCarrierOptions, NamesTheWrongField) {
  EXPECT_EQ(SpatialCarrierOptions{}.Validate(), "");
  EXPECT_EQ(SpatialCarrierOptions{.max_speed_mps = 0.0}.Validate(), "max_speed_mps: must be in (0, 100]");
  EXPECT_EQ(SpatialCarrierOptions{.max_turn_rate_radps = NAN}.Validate(), "max_turn_rate_radps: must be in (0, 100]");
  EXPECT_EQ(SpatialCarrierOptions{.max_tilt_rad = 1.0}.Validate(), "max_tilt_rad: must be in 0..0.6");
  EXPECT_EQ(SpatialCarrierOptions{.max_height_m = 0.1}.Validate(), "max_height_m: must be in min_height_m..100");
  EXPECT_EQ(SpatialCarrierOptions{.clearance_m = 0.0}.Validate(), "clearance_m: must be in (0, 10]");
  EXPECT_EQ(SpatialCarrierOptions{.rest_s = -1.0}.Validate(), "rest_s: must be in 0..1e5");
}

}  // namespace
}  // namespace lcmslam
