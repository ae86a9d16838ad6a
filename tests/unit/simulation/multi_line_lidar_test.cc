#include "simulation/multi_line_lidar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "simulation/spatial_worlds.h"
#include "unit/simulation/cast_rays.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// Up to 2 m/s and more than 2 rad/s, about all axes, in the middle of the bare room.
SpatialMotion WildMotion() {
  std::vector<MotionVector> control_points;
  for (int i = 0; i < 12; ++i) {
    const double s = i % 2 == 0 ? 1.0 : -1.0;
    MotionVector c;
    c << 3.0 + 0.3 * s, 2.5 + 0.2 * i / 12.0, 1.3 + 0.2 * s, 0.8 * i, 0.3 * s, -0.25 * s;
    control_points.push_back(c);
  }
  return SpatialMotion(0.3, control_points);
}

SpatialMotion StandingStill() {
  MotionVector c;
  c << 3.0, 2.0, 1.3, 0.0, 0.0, 0.0;
  return SpatialMotion(1.0, std::vector<MotionVector>(4, c));
}

MultiLineLidarOptions Exact(MultiLineModel model) {
  MultiLineLidarOptions options{.model = std::move(model), .range_sigma_m = 0.0};
  options.T_body_lidar = {{0.2, -0.1, 0.15}, Eigen::Quaterniond(0.95, 0.1, -0.2, 0.1).normalized()};
  return options;
}

Vector3d Position(const SweepPoint& p) { return Vector3d(p.x, p.y, p.z); }

// Where the beam of a point leaves the axis of the head, and the way from there to the point.
Vector3d BeamStart(const SweepPoint& p, const MultiLineModel& model) {
  return std::ranges::find(model.lasers, p.ring, &Laser::ring)->height_m * Vector3d::UnitZ();
}
Vector3d AlongBeam(const SweepPoint& p, const MultiLineModel& model) { return Position(p) - BeamStart(p, model); }

const std::vector<std::string_view> kNames = {"vlp16", "hdl32e", "hdl64e", "os1-64"};

// The oracle of motion distortion: each point, placed with the pose of its own time, lies on a wall of the bare room.
TEST(SimulateSweep, EachPointIsSeenFromThePoseOfItsTime) {
  const SpatialWorld world = BareRoomWorld();
  const SpatialMotion motion = WildMotion();
  for (const std::string_view name : kNames) {
    SCOPED_TRACE(name);
    const MultiLineLidarOptions options = Exact(*NamedMultiLineModel(name));
    const Sweep sweep = SimulateSweep(world, motion, 7, options, 1).sweep;
    ASSERT_GT(sweep.points.size(), 20'000u);
    double worst_m = 0.0;
    double worst_without_deskew_m = 0.0;
    for (const SweepPoint& p : sweep.points) {
      const auto surface_distance = [&](int64_t utime) {
        const Pose3 T_world_lidar = motion.PoseAt(1e-6 * static_cast<double>(utime)) * options.T_body_lidar;
        return world.Distance(T_world_lidar * Position(p), 1.0);
      };
      worst_m = std::max(worst_m, surface_distance(sweep.utime + p.dt_us));
      worst_without_deskew_m = std::max(worst_without_deskew_m, surface_distance(sweep.utime));
    }
    EXPECT_LT(worst_m, 2e-5) << "stamps are rounded to 1 us, the world is cast in float";
    EXPECT_GT(worst_without_deskew_m, 0.05) << "the motion does distort";
  }
}

TEST(SimulateSweep, WithoutDistortionAllPointsAreSeenFromTheEnd) {
  const SpatialWorld world = BareRoomWorld();
  const SpatialMotion motion = WildMotion();
  MultiLineLidarOptions options = Exact(VelodyneVlp16());
  options.motion_distortion = false;
  const Sweep sweep = SimulateSweep(world, motion, 7, options, 1).sweep;
  const Pose3 T_world_lidar = motion.PoseAt(1e-6 * static_cast<double>(sweep.utime)) * options.T_body_lidar;
  ASSERT_GT(sweep.points.size(), 20'000u);
  for (const SweepPoint& p : sweep.points) {
    ASSERT_LT(world.Distance(T_world_lidar * Position(p), 1.0), 2e-5);
    ASSERT_EQ(p.dt_us, 0);
  }
}

// Directions of shots from the sensor's manual: azimuth by time, clockwise, and elevation by ring.
TEST(SimulateSweep, BeamsPointWhereTheHeadLooks) {
  const SpatialWorld world = BareRoomWorld();
  for (const std::string_view name : {"vlp16", "hdl32e", "hdl64e"}) {  // the OS1 staggers its beams
    SCOPED_TRACE(name);
    MultiLineLidarOptions options{.model = *NamedMultiLineModel(name), .range_sigma_m = 0.0};
    const Sweep sweep = SimulateSweep(world, StandingStill(), 3, options, 1).sweep;
    int32_t last_dt_us = INT32_MIN;
    for (const SweepPoint& p : sweep.points) {
      const auto laser = std::ranges::find(options.model.lasers, p.ring, &Laser::ring);
      const Vector3d beam = AlongBeam(p, options.model);
      EXPECT_NEAR(std::asin(beam.z() / beam.norm()), laser->elevation_rad, 1e-6);
      const double azimuth_rad = -kTurn_rad * 1e-6 * static_cast<double>(sweep.utime + p.dt_us) / options.model.turn_s;
      ASSERT_NEAR(WrapAngle(std::atan2(p.y, p.x) - azimuth_rad), 0.0, 0.6e-6 * kTurn_rad / options.model.turn_s + 1e-6);
      ASSERT_GE(p.dt_us, last_dt_us);
      ASSERT_LE(p.dt_us, 0);
      last_dt_us = p.dt_us;
    }
  }
}

TEST(SimulateSweep, SweepsFollowWithoutGapOrOverlap) {
  const SpatialWorld world = BareRoomWorld();
  const MultiLineLidarOptions options{.range_sigma_m = 0.0};
  size_t shots = 0;
  int64_t last_utime = -56;
  for (int i = 0; i < 20; ++i) {
    const Sweep sweep = SimulateSweep(world, StandingStill(), i, options, 1).sweep;
    EXPECT_NEAR(static_cast<double>(sweep.utime + sweep.points.front().dt_us - last_utime), 55.296 - 15 * 2.304,
                1.0 + (i == 0 ? 40 : 0));
    last_utime = sweep.utime;
    shots += sweep.points.size();
  }
  EXPECT_EQ(shots, 16u * static_cast<size_t>(std::ceil(2e6 / 55.296))) << "in a closed room every shot returns";
}

TEST(SimulateSweep, NoiseIsAlongTheBeam) {
  const SpatialWorld world = BareRoomWorld();
  const MultiLineLidarOptions exact{.range_sigma_m = 0.0};
  const MultiLineLidarOptions noisy{.range_sigma_m = 0.05};
  const Sweep truth = SimulateSweep(world, WildMotion(), 2, exact, 5).sweep;
  const Sweep sweep = SimulateSweep(world, WildMotion(), 2, noisy, 5).sweep;
  ASSERT_EQ(sweep.points.size(), truth.points.size());
  double sum = 0.0, squares = 0.0;
  for (size_t i = 0; i < truth.points.size(); ++i) {
    const Vector3d a = AlongBeam(truth.points[i], exact.model), b = AlongBeam(sweep.points[i], exact.model);
    ASSERT_LT(a.normalized().cross(b).norm(), 1e-5);
    sum += b.norm() - a.norm();
    squares += (b.norm() - a.norm()) * (b.norm() - a.norm());
  }
  const double n = static_cast<double>(truth.points.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * n));
}

TEST(SimulateSweep, NoiseDependsOnSeedAndSweepOnly) {
  const SpatialWorld world = BareRoomWorld();
  const MultiLineLidarOptions options;
  const auto first_range = [&](int index, uint64_t seed) {
    return Position(SimulateSweep(world, StandingStill(), index, options, seed).sweep.points[0]).norm();
  };
  EXPECT_EQ(first_range(2, 1), first_range(2, 1));
  const std::set<double> ranges = {first_range(0, 1), first_range(1, 1), first_range(0, 2), first_range(1, 2)};
  EXPECT_EQ(ranges.size(), 4u);
}

TEST(SimulateSweep, DropoutsLeaveTheOtherPointsAlone) {
  const SpatialWorld world = BareRoomWorld();
  const Sweep full = SimulateSweep(world, WildMotion(), 0, {}, 1).sweep;
  const Sweep thin = SimulateSweep(world, WildMotion(), 0, {.dropout_probability = 0.2}, 1).sweep;
  const double n = static_cast<double>(full.points.size());
  EXPECT_NEAR(static_cast<double>(thin.points.size()), 0.8 * n, 4.0 * std::sqrt(0.16 * n));
  auto next = full.points.begin();
  for (const SweepPoint& p : thin.points) {
    next = std::find_if(next, full.points.end(), [&](const SweepPoint& q) {
      return q.x == p.x && q.y == p.y && q.z == p.z && q.dt_us == p.dt_us && q.ring == p.ring;
    });
    ASSERT_NE(next, full.points.end());
  }
  EXPECT_TRUE(SimulateSweep(world, WildMotion(), 0, {.dropout_probability = 1.0}, 1).sweep.points.empty());
}

// A plate at 4 m, seen at a right angle or slanted, dark or bright: the signal falls with cos(incidence) *
// reflectivity.
TEST(SimulateSweep, WeakEchoesAreLost) {
  const auto returns = [](double distance_m, double slant_deg, float reflectivity) {
    const Pose3 upright{{3.0 + distance_m, 2.0, 1.3},
                        Eigen::Quaterniond(Eigen::AngleAxisd(DegToRad(slant_deg), Vector3d::UnitZ()))};
    TriangleMesh plate;
    plate.AddQuad({0, -0.2, -0.02}, {0, 0.2, -0.02}, {0, 0.2, 0.02}, {0, -0.2, 0.02});
    const SpatialWorld world({{Transform(upright, plate), reflectivity}}, Vector3d::Zero());
    MultiLineModel model{.lasers = {Laser{}}, .firing_cycle_us = 50.0, .min_range_m = 1.0, .max_range_m = 6.0};
    return SimulateSweep(world, StandingStill(), 0, {.model = model, .range_sigma_m = 0.0}, 1).sweep.points;
  };
  ASSERT_FALSE(returns(4.0, 0.0, 1.0F).empty());
  EXPECT_NEAR(returns(4.0, 0.0, 1.0F).front().intensity, 255.0F, 0.5F);
  EXPECT_TRUE(returns(6.1, 0.0, 1.0F).empty()) << "beyond max_range_m";
  EXPECT_TRUE(returns(0.9, 0.0, 1.0F).empty()) << "closer than min_range_m";
  EXPECT_FALSE(returns(4.0, 60.0, 1.0F).empty()) << "6 sqrt(0.5) = 4.24 m";
  EXPECT_NEAR(returns(4.0, 60.0, 1.0F).front().intensity, 127.5F, 8.0F);
  EXPECT_TRUE(returns(4.0, 70.0, 1.0F).empty()) << "6 sqrt(0.34) = 3.5 m";
  EXPECT_TRUE(returns(4.0, 0.0, 0.4F).empty()) << "6 sqrt(0.4) = 3.8 m";
}

// The bound's information from ranges cast again at slightly other poses.
TEST(SimulateSweep, BoundAsFromNumericDerivatives) {
  const SpatialWorld world = BareRoomWorld();
  const SpatialMotion motion = WildMotion();
  MultiLineLidarOptions options = Exact(VelodyneVlp16());
  options.motion_distortion = false;
  const Sweep sweep = SimulateSweep(world, motion, 3, options, 1).sweep;
  const Pose3 T_world_body = motion.PoseAt(1e-6 * static_cast<double>(sweep.utime));
  const auto ranges_from = [&](const Pose3& T_world_moved) {
    std::vector<TestRay> rays;
    const Pose3 T_world_lidar = T_world_moved * options.T_body_lidar;
    for (const SweepPoint& p : sweep.points) {
      const Vector3d origin = T_world_lidar * BeamStart(p, options.model);
      const Vector3d direction = T_world_lidar.rotation * AlongBeam(p, options.model).normalized();
      rays.push_back({origin.cast<float>(), direction.cast<float>()});
    }
    const std::vector<TestHit> hits = CastRays(world, rays);
    return hits;
  };
  constexpr double kStep = 2e-3;
  Eigen::MatrixXd jacobian(sweep.points.size(), 6);
  for (int axis = 0; axis < 6; ++axis) {
    std::array<std::vector<TestHit>, 2> hits;
    for (const int side : {0, 1}) {
      const Vector3d step = (side == 0 ? -kStep : kStep) * Vector3d::Unit(axis % 3);
      Pose3 moved = T_world_body;
      if (axis < 3) moved.translation += step;
      if (axis >= 3) moved.rotation = Eigen::AngleAxisd(step.norm(), step.normalized()) * moved.rotation;
      hits[static_cast<size_t>(side)] = ranges_from(moved);
    }
    for (size_t i = 0; i < sweep.points.size(); ++i) {
      const bool across_corner = hits[0][i].normal.dot(hits[1][i].normal) < 0.99F;
      const double slope = across_corner ? 0.0 : (hits[1][i].range_m - hits[0][i].range_m) / (2.0 * kStep);
      jacobian(static_cast<Eigen::Index>(i), axis) = slope;
    }
  }
  options.range_sigma_m = 0.02;
  const std::optional<Matrix6d> bound = SimulateSweep(world, motion, 3, options, 1).bound;
  ASSERT_TRUE(bound.has_value());
  const Matrix6d expected = 4e-4 * (jacobian.transpose() * jacobian).inverse();
  EXPECT_LT((*bound - expected).norm(), 0.02 * expected.norm()) << *bound << "\n\n" << expected;
  EXPECT_LT(std::sqrt(bound->topLeftCorner<3, 3>().trace()), 1e-3) << "29,000 points of 20 mm: well below 1 mm";
}

TEST(SimulateSweep, NoBoundWithoutSightOfEnoughWalls) {
  const SpatialWorld plate({{MakeBox({100.0, 100.0, 1.0}), 1.0F}}, Vector3d::Zero());
  const SimulatedSweep floor_only = SimulateSweep(plate, StandingStill(), 0, {}, 1);
  EXPECT_GT(floor_only.sweep.points.size(), 10'000u);
  EXPECT_FALSE(floor_only.bound.has_value());
  const SimulatedSweep walls_only = SimulateSweep(BareRoomWorld(), StandingStill(), 0, {}, 1);
  EXPECT_FALSE(walls_only.bound.has_value()) << "a level VLP-16 there sees neither floor nor ceiling: no height";
  EXPECT_EQ(SimulateSweep(BareRoomWorld(), WildMotion(), 0, {.range_sigma_m = 0.0}, 1).bound, Matrix6d::Zero());
}

TEST(MultiLineLidarOptions, NamesTheWrongField) {
  EXPECT_EQ(MultiLineLidarOptions{}.Validate(), "");
  EXPECT_EQ(MultiLineLidarOptions{.range_sigma_m = -1.0}.Validate(), "range_sigma_m: must not be negative");
  EXPECT_EQ(MultiLineLidarOptions{.dropout_probability = NAN}.Validate(), "dropout_probability: must be in 0..1");
  EXPECT_EQ(MultiLineLidarOptions{.model = {.lasers = {}}}.Validate(), "model.lasers: must be 1..1000");
  MultiLineLidarOptions options;
  std::swap(options.model.lasers[0], options.model.lasers[1]);
  EXPECT_EQ(options.Validate(), "model.lasers: must be in firing order");
  options = {};
  options.model.firing_cycle_us = 30.0;
  EXPECT_EQ(options.Validate(), "model.firing_cycle_us: must exceed the last fire_delay_us");
}

}  // namespace
}  // namespace lcmslam
