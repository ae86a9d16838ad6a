#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose3.h"
#include "lidar/imu_sample.h"
#include "lidar/sweep.h"
#include "simulation/imu.h"
#include "simulation/multi_line_lidar.h"
#include "simulation/spatial_carrier.h"
#include "simulation/spatial_motion.h"
#include "simulation/spatial_odometry.h"
#include "simulation/spatial_world.h"

namespace lcmslam {

struct SpatialEpisodeOptions {
  uint64_t seed = 1;  // motion and every noise; the world is the caller's
  double duration_s = 60.0;
  int64_t start_utime = 1'000'000;  // us; the lidar starts to fire
  MultiLineLidarOptions lidar = {};
  SpatialCarrierOptions carrier = {};
  ImuOptions imu = {};
  OdometryOptions odometry = {};

  std::string Validate() const;
};

struct SpatialFrame {
  Sweep sweep;
  Pose3 T_world_body;             // at sweep.utime
  std::optional<Matrix6d> bound;  // Cramer-Rao, see SimulatedSweep
};

// A seeded journey of a multi-line lidar through a world. Same world and options, same bytes.
//   const std::optional<SpatialEpisode> episode = SpatialEpisode::Create(Hall10World(), {.seed = 3});
//   for (int i = 0; i < episode->num_frames(); ++i) const SpatialFrame frame = episode->Frame(i);
class SpatialEpisode {
 public:
  // None where the options are not valid or the world leaves no room to move with the wanted clearance.
  [[nodiscard]] static std::optional<SpatialEpisode> Create(SpatialWorld world, const SpatialEpisodeOptions& options);

  int num_frames() const;
  // Sweep i and its truth, in any order; pure, hence safe from several threads.
  [[nodiscard]] SpatialFrame Frame(int i) const;
  // The truth at any time; T_world_body is that of the ends before the start and after the end.
  [[nodiscard]] BodyState TrueStateAt(int64_t utime) const;

  const SpatialWorld& world() const { return world_; }
  const SpatialMotion& motion() const { return motion_; }
  const std::vector<ImuSample>& imu() const { return imu_; }
  const Trajectory& odometry() const { return odometry_; }  // T_odom_body, see SimulateSpatialOdometry
  const SpatialEpisodeOptions& options() const { return options_; }

 private:
  SpatialEpisode(SpatialWorld world, SpatialMotion motion, const SpatialEpisodeOptions& options);

  SpatialWorld world_;
  SpatialMotion motion_;  // its time 0 is start_utime
  SpatialEpisodeOptions options_;
  std::vector<ImuSample> imu_;
  Trajectory odometry_;
};

}  // namespace lcmslam
