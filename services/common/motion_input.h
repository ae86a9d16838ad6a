#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Geometry>

#include "geometry/pose3.h"
#include "geometry/trajectory.h"
#include "lidar/imu_sample.h"

namespace lcmslam {

// How the lidar moved between two times, in its own frame at the first, as other sensors saw it.
struct LidarMotion {
  std::optional<Eigen::Quaterniond> rotation;  // gyroscope
  std::optional<Pose3> odometry;               // T_from_to
};

// Keeps the last seconds of odometry and gyroscope readings. Stamps have to rise: readings with other ones are dropped,
// but one that is far back starts afresh.
class MotionInput {
 public:
  void SetMounting(const Pose3& T_body_lidar) { T_body_lidar_ = T_body_lidar; }

  void AddOdometry(const StampedPose& T_odom_body);
  // In the body's axes.
  void AddImu(const ImuSample& sample);

  // Only what covers the whole time: odometry at most 0.2 s apart, gyroscope readings 0.03 s.
  LidarMotion Between(int64_t from_utime, int64_t to_utime) const;

 private:
  std::optional<Pose3> OdometryBetween(int64_t from_utime, int64_t to_utime) const;
  std::optional<Eigen::Quaterniond> TurnBetween(int64_t from_utime, int64_t to_utime) const;

  Pose3 T_body_lidar_;
  std::deque<StampedPose> odometry_;
  std::deque<ImuSample> imu_;
};

}  // namespace lcmslam
