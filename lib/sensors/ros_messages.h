#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/pose3.h"
#include "lidar/imu_sample.h"
#include "lidar/planar_scan.h"
#include "sensors/byte_reader.h"

namespace lcmslam {

// std_msgs/Header, with which stamped messages begin.
struct RosHeader {
  int64_t utime = 0;  // us
  std::string frame;  // without a leading '/'
};
[[nodiscard]] RosHeader GetRosHeader(ByteReader& reader);
// For the end of a message: throws BadInput when bytes are left.
void RequireEmpty(const ByteReader& reader);

// sensor_msgs/LaserScan.
struct RosLaserScan {
  int64_t utime = 0;  // us; of the first beam
  std::string frame;
  float angle_min_rad = 0.0F;
  float angle_increment_rad = 0.0F;
  float time_increment_s = 0.0F;  // 0: unknown
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;
  std::vector<float> ranges_m;
};

// A pose of `child_frame` in `frame`: T_frame_child. Not checked for being a pose: see Pose3::IsRigid().
struct RosPose {
  int64_t utime = 0;        // us
  std::string frame;        // without a leading '/'
  std::string child_frame;  // "" where the type has none
  Pose3 T_frame_child;
};

// Decoders of serialized messages. They throw BadInput when the bytes are shorter or longer than the type's fields.
// Pure.
[[nodiscard]] RosLaserScan DecodeRosLaserScan(std::span<const uint8_t> data);

// sensor_msgs/Imu. What is not finite stays.
[[nodiscard]] ImuSample DecodeRosImu(std::span<const uint8_t> data);

// geometry_msgs/PoseStamped, PoseWithCovarianceStamped, TransformStamped, nav_msgs/Odometry.
[[nodiscard]] bool IsRosPoseType(std::string_view type);
[[nodiscard]] RosPose DecodeRosPose(std::string_view type, std::span<const uint8_t> data);

// tf/tfMessage and tf2_msgs/TFMessage, which are the same.
[[nodiscard]] bool IsRosTransformsType(std::string_view type);
[[nodiscard]] std::vector<RosPose> DecodeRosTransforms(std::span<const uint8_t> data);

// Stamped with the last beam. Ranges outside the sensor's limits are 0, no return. `upside_down`: the sensor's z axis
// points down; the result is in the sensor's frame turned by pi about its x axis, so that angles are counter-clockwise
// from above.
[[nodiscard]] PlanarScan ToPlanarScan(const RosLaserScan& scan, bool upside_down);

}  // namespace lcmslam
