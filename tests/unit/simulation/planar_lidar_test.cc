#include "simulation/planar_lidar.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "simulation/planar_worlds.h"

namespace lcmslam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Pose2 kTWorldBody(2.4, 2.6, 0.3);
const Pose2 kTBodyLidar(0.2, -0.1, 0.5);

Pose2 StandStill(int64_t) { return kTWorldBody; }

// 0.9 m/s forward, 1.5 rad/s, at kTWorldBody at time 0.
Pose2 MoveFast(int64_t utime) { return kTWorldBody * Pose2::Exp(1e-6 * utime * Vector3d(0.9, 0.0, 1.5)); }

SimulatedScan Simulate(const PlanarWorld& world, const PoseAtTime& T_world_body, const PlanarLidarOptions& options,
                       uint64_t seed = 1) {
  Rng rng = MakeRng(seed, RandomStream::kRange);
  return SimulateScan(world, {}, T_world_body, 0, options, rng);
}

// How far the end of a beam that was sent from the given pose lies from the nearest wall.
double DistanceToWall(const PlanarWorld& world, const Pose2& T_world_lidar, const Beam& beam) {
  return world.Distance(T_world_lidar *
                        Vector2d(beam.range_m * std::cos(beam.angle_rad), beam.range_m * std::sin(beam.angle_rad)));
}

TEST(PlanarLidar, ModelsHaveTheirDataSheetsFigures) {
  const PlanarLidarModel urg = HokuyoUrg04LxUg01();
  EXPECT_EQ(urg.num_beams, 667);
  EXPECT_NEAR(RadToDeg(urg.first_angle_rad), -120.0, 1e-9);
  EXPECT_NEAR(urg.sweep_s(), 0.1 * 240.0 / 360.0, 1e-12);
  const PlanarLidarModel utm = HokuyoUtm30Lx();
  EXPECT_EQ(utm.num_beams, 1081);
  EXPECT_NEAR(RadToDeg(utm.first_angle_rad), -135.0, 1e-9);
  EXPECT_NEAR(utm.sweep_s(), 0.025 * 270.0 / 360.0, 1e-12);
  for (const PlanarLidarModel& rplidar : {RplidarA1(), RplidarA2()}) {
    EXPECT_NEAR(1.0 / rplidar.beam_interval_s(), 8000.0, 5.0);
    EXPECT_LT(rplidar.angle_step_rad, 0.0);
    EXPECT_NEAR(rplidar.num_beams * rplidar.beam_interval_s(), rplidar.turn_s, 1e-12);
  }
  for (const PlanarLidarModel& model : {urg, utm, RplidarA1(), RplidarA2()}) EXPECT_EQ(model.Validate(), "");
}

TEST(PlanarLidar, NoiseFreeBeamsEndOnWalls) {
  const PlanarWorld world = Room5World();
  const SimulatedScan simulated = Simulate(world, StandStill, {.T_body_lidar = kTBodyLidar});
  ASSERT_EQ(simulated.scan.beams.size(), 667U);
  for (const Beam& beam : simulated.scan.beams) {
    ASSERT_TRUE(beam.HasReturn());
    EXPECT_LT(DistanceToWall(world, kTWorldBody * kTBodyLidar, beam), 1e-6);
  }
}

TEST(PlanarLidar, EveryBeamIsSentFromThePoseAtItsTime) {
  const PlanarWorld world = Room5World();
  const SimulatedScan simulated = Simulate(world, MoveFast, {.T_body_lidar = kTBodyLidar});
  EXPECT_EQ(simulated.scan.beams.front().dt_us, -66'667);
  EXPECT_EQ(simulated.scan.beams.back().dt_us, 0);
  for (const Beam& beam : simulated.scan.beams) {
    EXPECT_LT(DistanceToWall(world, MoveFast(beam.dt_us) * kTBodyLidar, beam), 1e-6);
  }
}

TEST(PlanarLidar, WithoutDistortionAllBeamsAreSentFromTheLastPose) {
  const PlanarWorld world = Room5World();
  const SimulatedScan simulated = Simulate(world, MoveFast, {.motion_distortion = false});
  for (const Beam& beam : simulated.scan.beams) {
    EXPECT_EQ(beam.dt_us, 0);
    EXPECT_LT(DistanceToWall(world, kTWorldBody, beam), 1e-6);
  }
}

TEST(PlanarLidar, OutOfRangeIsNoReturn) {
  const PlanarWorld far({{{2.0, -50.0}, {2.0, 50.0}}, {{-0.5, -50.0}, {-0.5, 50.0}}});
  PlanarLidarOptions options;
  options.model.min_range_m = 1.0;
  options.model.max_range_m = 3.0;
  Rng rng(1);
  const SimulatedScan simulated = SimulateScan(
      far, {}, [](int64_t) { return Pose2(); }, 0, options, rng);
  for (const Beam& beam : simulated.scan.beams) {
    const double wall_m =
        std::cos(beam.angle_rad) > 0.0 ? 2.0 / std::cos(beam.angle_rad) : -0.5 / std::cos(beam.angle_rad);
    EXPECT_EQ(beam.HasReturn(), wall_m >= 1.0 && wall_m <= 3.0) << beam.angle_rad;
  }
}

TEST(PlanarLidar, NoiseHasTheRatedSpread) {
  EXPECT_DOUBLE_EQ(RangeNoise::Rated().Sigma(0.4), 0.03);
  EXPECT_DOUBLE_EQ(RangeNoise::Rated().Sigma(4.0), 0.12);
  EXPECT_DOUBLE_EQ(RangeNoise::Low().Sigma(4.0), 0.01);

  const PlanarWorld world = Room5World();
  const SimulatedScan exact = Simulate(world, StandStill, {});
  double sum = 0.0;
  double sum_of_squares = 0.0;
  int count = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const SimulatedScan noisy = Simulate(world, StandStill, {.noise = RangeNoise::Rated()}, seed);
    for (size_t i = 0; i < noisy.scan.beams.size(); ++i) {
      const double range_m = exact.scan.beams[i].range_m;
      const double error = (noisy.scan.beams[i].range_m - range_m) / RangeNoise::Rated().Sigma(range_m);
      sum += error;
      sum_of_squares += error * error;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(sum_of_squares / count, 1.0, 4.0 * std::sqrt(2.0 / count));
}

// The Fisher information by finite differences of the noise-free ranges.
TEST(PlanarLidar, BoundMatchesNumericDerivatives) {
  const PlanarWorld world = Room5World();
  const PlanarLidarOptions options{.noise = RangeNoise::Rated(), .T_body_lidar = kTBodyLidar};
  PlanarLidarOptions exact = options;
  exact.noise = RangeNoise::None();
  constexpr double kStep = 2e-4;
  const auto ranges = [&](const Vector3d& offset) {
    // World axes about the body's origin at the last beam; the motion before that moves along.
    const auto moved = [&](int64_t utime) {
      const Pose2 T_last_now = kTWorldBody.inverse() * MoveFast(utime);
      return Pose2(kTWorldBody.x() + offset.x(), kTWorldBody.y() + offset.y(), kTWorldBody.yaw() + offset.z()) *
             T_last_now;
    };
    return Simulate(world, moved, exact).scan.beams;
  };
  const auto at = ranges(Vector3d::Zero());
  std::array<std::vector<Beam>, 3> plus, minus;
  for (int axis = 0; axis < 3; ++axis) {
    plus[axis] = ranges(kStep * Vector3d::Unit(axis));
    minus[axis] = ranges(-kStep * Vector3d::Unit(axis));
  }
  Matrix3d information = Matrix3d::Zero();
  for (size_t i = 0; i < at.size(); ++i) {
    Vector3d jacobian;
    for (int axis = 0; axis < 3; ++axis)
      jacobian[axis] = (plus[axis][i].range_m - minus[axis][i].range_m) / (2.0 * kStep);
    if (jacobian.norm() > 100.0) continue;  // the beam steps from one surface to another: no derivative
    jacobian /= options.noise.Sigma(at[i].range_m);
    information += jacobian * jacobian.transpose();
  }
  const Matrix3d bound = *Simulate(world, MoveFast, options).bound;
  EXPECT_TRUE(bound.isApprox(information.inverse(), 0.02)) << bound << "\n\n" << information.inverse();
}

TEST(PlanarLidar, BoundIsZeroWithoutNoiseAndNoneInAnEndlessCorridor) {
  EXPECT_TRUE(Simulate(Room5World(), StandStill, {}).bound->isZero());
  const PlanarWorld corridor({{{-50.0, 0.0}, {50.0, 0.0}}, {{-50.0, 5.0}, {50.0, 5.0}}});
  EXPECT_FALSE(Simulate(corridor, StandStill, {}).bound.has_value());
  EXPECT_FALSE(Simulate(corridor, StandStill, {.noise = RangeNoise::Low()}).bound.has_value());
  EXPECT_FALSE(Simulate(PlanarWorld({}), StandStill, {}).bound.has_value());
}

TEST(PlanarLidar, ValidateNamesTheField) {
  PlanarLidarOptions options;
  options.model.turn_s = NAN;
  EXPECT_EQ(options.Validate(), "model.turn_s: must be in 0.001..1000");
  options = {};
  options.model.num_beams = 5000;
  EXPECT_EQ(options.Validate(), "model.angle_step_rad: the beams exceed one turn");
  options = {.noise = {.sigma_m = NAN}};
  EXPECT_EQ(options.Validate(), "noise.sigma_m: must not be negative");
  options = {.T_body_lidar = Pose2(0.0, NAN, 0.0)};
  EXPECT_EQ(options.Validate(), "T_body_lidar: must be finite");
}

}  // namespace
}  // namespace lcmslam
