#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lidar/multi_line_model.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

// A lidar around the start of one firing cycle, to first order in time: exact to nanometres within a cycle. World
// frame.
struct CycleMotion {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_world_lidar = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();
};

// The shots of consecutive firing cycles. Their rays are ordered for the caster, not in time: one laser's shots lie
// side by side, then those of the next higher laser, so that neighbours form narrow bundles.
class FiringBlock {
 public:
  static constexpr int kCycles = 16;

  explicit FiringBlock(const MultiLineModel& model);

  // How the lidar moves and where its head points in a cycle, 0..kCycles - 1.
  void SetCycle(int cycle, const CycleMotion& lidar, double head_azimuth_rad);
  // Computes the rays of all cycles.
  void Aim();

  const SpatialRays& rays() const { return rays_; }
  // Of the shot that laser `laser` of the model fires.
  Eigen::Index RayOf(size_t laser, int cycle) const { return first_rays_[laser] + cycle; }
  // Of that shot as the lidar reports it: in the lidar's frame, without its own motion.
  Eigen::Vector3f Direction(size_t laser, int cycle) const {
    const Eigen::Vector3f& d = beams_[laser].direction;
    return {head_cos_[cycle] * d.x() - head_sin_[cycle] * d.y(), head_sin_[cycle] * d.x() + head_cos_[cycle] * d.y(),
            d.z()};
  }

 private:
  using Lanes = Eigen::Array<float, kCycles, 1>;
  using VectorLanes = Eigen::Array<float, kCycles, 3>;  // a row a cycle

  struct Beam {
    Eigen::Vector3f direction;  // at the start of a cycle that begins at azimuth 0, turned on by the laser's own delay
    float height_m;
    float delay_s;
  };

  std::vector<Beam> beams_;               // by laser
  std::vector<Eigen::Index> first_rays_;  // by laser
  SpatialRays rays_;
  VectorLanes origins_, velocities_, rates_;
  VectorLanes x_axes_, y_axes_, z_axes_;  // of the turned head, world frame
  Lanes head_cos_, head_sin_;
};

}  // namespace lcmslam
