#include "simulation/spatial_motion.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>

#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

SpatialMotion RandomMotion(uint64_t seed) {
  Rng rng = MakeRng(seed, RandomStream::kMotion);
  boost::random::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<MotionVector> control_points(9);
  for (MotionVector& c : control_points) {
    for (double& value : c) value = uniform(rng);
  }
  return SpatialMotion(0.4, control_points);
}

TEST(SpatialMotion, DerivativesAsCentralDifferences) {
  constexpr double kStep_s = 1e-5;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const SpatialMotion motion = RandomMotion(seed);
    EXPECT_DOUBLE_EQ(motion.duration_s(), 2.4);
    for (double t_s = 0.013; t_s < 2.4; t_s += 0.09) {
      const BodyState before = motion.StateAt(t_s - kStep_s);
      const BodyState at = motion.StateAt(t_s);
      const BodyState after = motion.StateAt(t_s + kStep_s);
      const Vector3d moved = after.T_world_body.translation - before.T_world_body.translation;
      EXPECT_LT((moved / (2.0 * kStep_s) - at.velocity_mps).norm(), 1e-6);
      EXPECT_LT(((after.velocity_mps - before.velocity_mps) / (2.0 * kStep_s) - at.acceleration_mps2).norm(), 1e-5);
      const Eigen::Quaterniond turned = before.T_world_body.rotation.conjugate() * after.T_world_body.rotation;
      const Vector3d rate_radps = 2.0 * turned.vec() * (turned.w() < 0.0 ? -1.0 : 1.0) / (2.0 * kStep_s);
      EXPECT_LT((rate_radps - at.angular_velocity_radps).norm(), 1e-6);
    }
  }
}

TEST(SpatialMotion, AccelerationIsContinuousAtKnots) {
  const SpatialMotion motion = RandomMotion(1);
  for (int knot = 1; knot < 6; ++knot) {
    const BodyState before = motion.StateAt(0.4 * knot - 1e-9);
    const BodyState after = motion.StateAt(0.4 * knot + 1e-9);
    EXPECT_LT((after.acceleration_mps2 - before.acceleration_mps2).norm(), 1e-6);
    EXPECT_LT((after.velocity_mps - before.velocity_mps).norm(), 1e-6);
  }
}

TEST(SpatialMotion, TimesOutsideAreTheEnds) {
  const SpatialMotion motion = RandomMotion(2);
  EXPECT_EQ(motion.PoseAt(-1.0).translation, motion.PoseAt(0.0).translation);
  EXPECT_EQ(motion.PoseAt(99.0).translation, motion.PoseAt(motion.duration_s()).translation);
}

TEST(SpatialMotion, EqualControlPointsStandStill) {
  MotionVector c;
  c << 1.0, 2.0, 3.0, 0.5, 0.1, -0.2;
  const SpatialMotion motion(0.5, std::vector<MotionVector>(4, c));
  const BodyState state = motion.StateAt(0.3);
  EXPECT_LT((state.T_world_body.translation - Vector3d(1.0, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT(state.velocity_mps.norm() + state.acceleration_mps2.norm() + state.angular_velocity_radps.norm(), 1e-12);
}

}  // namespace
}  // namespace lcmslam
