#include "simulation/firing_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

namespace lcmslam {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

Eigen::Vector3d HeadDirection(const Laser& laser, double turn_s) {
  const double azimuth_rad = laser.azimuth_rad - 1e-6 * kTurn_rad * laser.fire_delay_us / turn_s;
  return {std::cos(laser.elevation_rad) * std::cos(azimuth_rad), std::cos(laser.elevation_rad) * std::sin(azimuth_rad),
          std::sin(laser.elevation_rad)};
}

}  // namespace

FiringBlock::FiringBlock(const MultiLineModel& model)
    : first_rays_(model.lasers.size()), rays_(static_cast<Eigen::Index>(model.lasers.size()) * kCycles) {
  for (const Laser& laser : model.lasers) {
    beams_.push_back({.direction = HeadDirection(laser, model.turn_s).cast<float>(),
                      .height_m = static_cast<float>(laser.height_m),
                      .delay_s = static_cast<float>(1e-6 * laser.fire_delay_us)});
  }
  std::vector<size_t> by_elevation(model.lasers.size());
  std::iota(by_elevation.begin(), by_elevation.end(), 0);
  std::ranges::stable_sort(by_elevation, {}, [&](size_t i) { return model.lasers[i].elevation_rad; });
  Eigen::Index ray = 0;
  for (const size_t laser : by_elevation) {
    first_rays_[laser] = ray;
    ray += kCycles;
  }
}

void FiringBlock::SetCycle(int cycle, const CycleMotion& lidar, double head_azimuth_rad) {
  head_cos_[cycle] = static_cast<float>(std::cos(head_azimuth_rad));
  head_sin_[cycle] = static_cast<float>(std::sin(head_azimuth_rad));
  const Eigen::AngleAxisd R_lidar_head(head_azimuth_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Matrix3f R_world_head = (lidar.R_world_lidar * R_lidar_head.toRotationMatrix()).cast<float>();
  x_axes_.row(cycle) = R_world_head.col(0);
  y_axes_.row(cycle) = R_world_head.col(1);
  z_axes_.row(cycle) = R_world_head.col(2);
  origins_.row(cycle) = lidar.origin.cast<float>();
  velocities_.row(cycle) = lidar.velocity_mps.cast<float>();
  rates_.row(cycle) = lidar.angular_velocity_radps.cast<float>();
}

void FiringBlock::Aim() {
  for (size_t i = 0; i < beams_.size(); ++i) {
    const Beam& beam = beams_[i];
    const VectorLanes still =
        beam.direction.x() * x_axes_ + beam.direction.y() * y_axes_ + beam.direction.z() * z_axes_;
    auto origins = rays_.origins.middleRows<kCycles>(first_rays_[i]);
    auto directions = rays_.directions.middleRows<kCycles>(first_rays_[i]);
    origins = origins_ + beam.delay_s * velocities_ + beam.height_m * z_axes_;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      directions.col(axis) =
          still.col(axis) + beam.delay_s * (rates_.col(next) * still.col(last) - rates_.col(last) * still.col(next));
    }
  }
}

}  // namespace lcmslam
