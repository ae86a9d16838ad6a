#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "sensor-bridge/sensor_publisher.h"
#include "simulation/planar_episode.h"
#include "simulation/spatial_episode.h"

namespace lcmslam {

// Of one scan: the root mean square errors that go with the Cramer-Rao bound's covariance.
struct PoseBound {
  double position_m = 0.0;
  double rotation_rad = 0.0;
};

// The Cramer-Rao bounds of an episode's scans.
class BoundSummary {
 public:
  // Writes utime_us,position_m,rotation_rad to `csv` if there is one: a row per scan, inf where it does not fix the
  // pose.
  explicit BoundSummary(std::ostream* csv = nullptr);

  // None: the scan does not fix the pose.
  void Add(int64_t utime, const std::optional<PoseBound>& bound);
  // "Cramer-Rao bound of one scan: position 0.633 mm, rotation 0.230 mrad; mean of 600".
  std::string Line() const;

 private:
  std::ostream* csv_;
  int64_t bounded_ = 0;    // scans that fix the pose
  int64_t unbounded_ = 0;  // scans that do not
  double sum_position_m_ = 0.0;
  double sum_rotation_rad_ = 0.0;
};

// Publishes the episode: its scans on LIDAR_2D with the extrinsics, GROUND_TRUTH at the scans' times and, if there is
// any, ODOMETRY. Stops early on SIGTERM or SIGINT.
void PublishEpisode(const PlanarEpisode& episode, SensorPublisher& publisher, BoundSummary& bound);
// The same with sweeps on LIDAR_3D and, if there are any, samples on IMU.
void PublishEpisode(const SpatialEpisode& episode, SensorPublisher& publisher, BoundSummary& bound);

}  // namespace lcmslam
