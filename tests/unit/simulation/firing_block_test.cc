#include "simulation/firing_block.h"

#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lcmslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Each ray against exact kinematics in double: the lidar turned and moved on to the time of the shot, the head turned
// on with it.
TEST(FiringBlock, AimsEachShotFromThePoseOfItsTime) {
  for (const MultiLineModel& model : {VelodyneVlp16(), VelodyneHdl64e(), OusterOs1_64()}) {
    FiringBlock block(model);
    const CycleMotion lidar{.origin = {3.0, -2.0, 1.5},
                            .R_world_lidar = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized().toRotationMatrix(),
                            .velocity_mps = {1.0, -0.5, 0.3},
                            .angular_velocity_radps = {0.7, 1.0, -1.2}};
    for (int cycle = 0; cycle < FiringBlock::kCycles; ++cycle) block.SetCycle(cycle, lidar, 0.2 * cycle);
    block.Aim();
    std::set<Eigen::Index> rays;
    for (int cycle = 0; cycle < FiringBlock::kCycles; ++cycle) {
      for (size_t i = 0; i < model.lasers.size(); ++i) {
        const Laser& laser = model.lasers[i];
        const double delay_s = 1e-6 * laser.fire_delay_us;
        const double azimuth_rad = 0.2 * cycle + laser.azimuth_rad - 2.0 * std::numbers::pi * delay_s / model.turn_s;
        const Vector3d d_lidar = AngleAxisd(azimuth_rad, Vector3d::UnitZ()) *
                                 AngleAxisd(-laser.elevation_rad, Vector3d::UnitY()) * Vector3d::UnitX();
        const double turned_rad = delay_s * lidar.angular_velocity_radps.norm();
        const Matrix3d R_world_lidar =
            AngleAxisd(turned_rad, lidar.angular_velocity_radps.normalized()) * lidar.R_world_lidar;
        const Vector3d origin =
            lidar.origin + delay_s * lidar.velocity_mps + laser.height_m * R_world_lidar * Vector3d::UnitZ();
        const Eigen::Index ray = block.RayOf(i, cycle);
        rays.insert(ray);
        const Vector3d aimed_from = block.rays().origins.row(ray).cast<double>();
        const Vector3d aimed_along = block.rays().directions.row(ray).cast<double>();
        ASSERT_LT((aimed_from - origin).norm(), 1e-6) << i << " in cycle " << cycle;
        ASSERT_LT((aimed_along - R_world_lidar * d_lidar).norm(), 5e-7) << i << " in cycle " << cycle;
        ASSERT_LT((block.Direction(i, cycle).cast<double>() - d_lidar).norm(), 5e-7) << i << " in cycle " << cycle;
      }
    }
    EXPECT_EQ(static_cast<Eigen::Index>(rays.size()), block.rays().size()) << "every shot has a ray of its own";
  }
}

// What makes casting fast: rays that lie side by side point in about the same direction.
TEST(FiringBlock, NeighboursFormNarrowBundles) {
  const MultiLineModel model = VelodyneHdl64e();
  FiringBlock block(model);
  for (int cycle = 0; cycle < FiringBlock::kCycles; ++cycle) {
    block.SetCycle(cycle, {}, -2e-6 * std::numbers::pi * cycle * model.firing_cycle_us / model.turn_s);
  }
  block.Aim();
  for (Eigen::Index ray = 1; ray < block.rays().size(); ++ray) {
    const Vector3d a = block.rays().directions.row(ray - 1).cast<double>();
    const Vector3d b = block.rays().directions.row(ray).cast<double>();
    EXPECT_LT((a - b).norm(), 0.06) << ray;
  }
}

}  // namespace
}  // namespace lcmslam
