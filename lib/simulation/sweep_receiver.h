#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

#include "simulation/firing_block.h"
#include "simulation/multi_line_lidar.h"
#include "simulation/random.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

// Makes points of the shots of a sweep that come back, and gathers how well they fix the pose.
class SweepReceiver {
 public:
  // The noise is that of sweep `index`. utime and p_world_body are those of the sweep's end. What `facets` and
  // `options` refer to must outlive the receiver.
  SweepReceiver(std::span<const Facet> facets, const MultiLineLidarOptions& options, int64_t utime,
                const Eigen::Vector3d& p_world_body, uint64_t seed, int index);

  // The first num_cycles of a block that begins with first_cycle; blocks come in the order of time.
  void Receive(const FiringBlock& block, const SpatialHits& hits, int64_t first_cycle, int num_cycles);
  SimulatedSweep Finish();

 private:
  void Measure(const FiringBlock& block, const SpatialHits& hits, int num_cycles);
  void Judge(const FiringBlock& block, const SpatialHits& hits, Eigen::Index first_ray);
  void AddPoints(const FiringBlock& block, int64_t first_cycle, int num_cycles);

  std::span<const Facet> facets_;
  const MultiLineLidarOptions& options_;
  Eigen::Vector3f p_world_body_;
  Rng range_rng_;
  Rng dropout_rng_;
  boost::random::normal_distribution<double> normal_;
  boost::random::uniform_01<double> uniform_;

  // By ray of the block:
  Eigen::ArrayXf ranges_m_;  // with noise; NaN where a shot was not fired or its return was lost
  Eigen::ArrayXf signals_;   // reflectivity * cos(incidence); 0 where nothing is seen

  Matrix6d information_ = Matrix6d::Zero();  // lower triangle, for a range noise of 1 m
  Sweep sweep_;
};

}  // namespace lcmslam
