#pragma once

#include <Eigen/Core>

#include "simulation/random.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

struct SpatialWayOptions {
  double min_height_m = 0.8;
  double max_height_m = 1.8;
  double clearance_m = 0.3;  // to the nearest surface, never less
};

// A random way without end through the free space of a world: straight legs between random places. Windows and doors
// do not lead out: seen from above, it stays within the world's bounds.
class SpatialWay {
 public:
  // From the world's p_inside over a few legs to a random start. World and rng must outlive it.
  SpatialWay(const SpatialWorld& world, const SpatialWayOptions& options, Rng& rng);

  // No leg leads on: the place is shut in, or closer than the clearance to a surface. Position() then stays.
  bool blocked() const { return blocked_; }
  const Eigen::Vector3d& position() const { return position_; }

  // Goes on along the legs; around a corner the new place is closer than `step_m` to the old.
  void Advance(double step_m);

 private:
  void StartLeg();
  Eigen::Vector3d RandomGoal();
  bool IsWithinBounds(const Eigen::Vector3d& goal) const;
  bool IsFree(const Eigen::Vector3d& goal) const;

  const SpatialWorld& world_;
  SpatialWayOptions options_;
  Rng& rng_;
  bool blocked_ = false;
  Eigen::Vector3d position_;
  Eigen::Vector3d goal_;
};

}  // namespace lcmslam
