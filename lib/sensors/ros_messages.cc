#include "sensors/ros_messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sensors/byte_reader.h"

namespace lcmslam {
namespace {

constexpr double kMaxScanDuration_s = 10.0;  // longer: time_increment is not what it should be

std::string GetFrame(ByteReader& reader) {
  std::string frame = reader.GetString();
  if (frame.starts_with('/')) frame.erase(0, 1);
  return frame;
}

// Position, then quaternion x, y, z, w: the layout of geometry_msgs/Pose and geometry_msgs/Transform.
Pose3 GetPose(ByteReader& reader) {
  std::array<double, 7> v;
  for (double& value : v) value = reader.Get<double>();
  return {{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};
}

Eigen::Vector3d GetVector(ByteReader& reader) {
  Eigen::Vector3d v;
  for (double& value : v) value = reader.Get<double>();
  return v;
}

}  // namespace

RosHeader GetRosHeader(ByteReader& reader) {
  reader.Get<uint32_t>();  // sequence
  const int64_t seconds = reader.Get<uint32_t>();
  const int64_t nanoseconds = reader.Get<uint32_t>();
  return {seconds * 1'000'000 + (nanoseconds + 500) / 1000, GetFrame(reader)};
}

void RequireEmpty(const ByteReader& reader) {
  if (!reader.empty()) throw BadInput(fmt::format("{} bytes more than the message type has", reader.size()));
}

RosLaserScan DecodeRosLaserScan(std::span<const uint8_t> data) {
  ByteReader reader(data);
  const RosHeader header = GetRosHeader(reader);
  RosLaserScan scan;
  scan.utime = header.utime;
  scan.frame = header.frame;
  scan.angle_min_rad = reader.Get<float>();
  reader.Get<float>();  // angle_max
  scan.angle_increment_rad = reader.Get<float>();
  scan.time_increment_s = reader.Get<float>();
  reader.Get<float>();  // scan_time
  scan.range_min_m = reader.Get<float>();
  scan.range_max_m = reader.Get<float>();
  for (ByteReader ranges(reader.GetSized(sizeof(float))); !ranges.empty();)
    scan.ranges_m.push_back(ranges.Get<float>());
  reader.GetSized(sizeof(float));  // intensities
  RequireEmpty(reader);
  return scan;
}

ImuSample DecodeRosImu(std::span<const uint8_t> data) {
  constexpr size_t kQuaternionBytes = 4 * sizeof(double), kCovarianceBytes = 9 * sizeof(double);
  ByteReader reader(data);
  ImuSample sample;
  sample.utime = GetRosHeader(reader).utime;
  reader.Take(kQuaternionBytes + kCovarianceBytes);
  sample.angular_velocity_radps = GetVector(reader);
  reader.Take(kCovarianceBytes);
  sample.specific_force_mps2 = GetVector(reader);
  reader.Take(kCovarianceBytes);
  RequireEmpty(reader);
  return sample;
}

bool IsRosPoseType(std::string_view type) {
  return type == "geometry_msgs/PoseStamped" || type == "geometry_msgs/PoseWithCovarianceStamped" ||
         type == "geometry_msgs/TransformStamped" || type == "nav_msgs/Odometry";
}

RosPose DecodeRosPose(std::string_view type, std::span<const uint8_t> data) {
  constexpr size_t kCovarianceBytes = 36 * sizeof(double), kTwistBytes = 6 * sizeof(double);
  ByteReader reader(data);
  const RosHeader header = GetRosHeader(reader);
  RosPose pose{header.utime, header.frame, "", {}};
  if (type == "nav_msgs/Odometry" || type == "geometry_msgs/TransformStamped") pose.child_frame = GetFrame(reader);
  pose.T_frame_child = GetPose(reader);
  if (type == "geometry_msgs/PoseWithCovarianceStamped") reader.Take(kCovarianceBytes);
  if (type == "nav_msgs/Odometry") reader.Take(kCovarianceBytes + kTwistBytes + kCovarianceBytes);
  RequireEmpty(reader);
  return pose;
}

bool IsRosTransformsType(std::string_view type) { return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage"; }

std::vector<RosPose> DecodeRosTransforms(std::span<const uint8_t> data) {
  ByteReader reader(data);
  std::vector<RosPose> transforms;
  for (uint32_t left = reader.Get<uint32_t>(); left > 0; --left) {
    const RosHeader header = GetRosHeader(reader);
    const std::string child_frame = GetFrame(reader);
    transforms.push_back({header.utime, header.frame, child_frame, GetPose(reader)});
  }
  RequireEmpty(reader);
  return transforms;
}

PlanarScan ToPlanarScan(const RosLaserScan& scan, bool upside_down) {
  const double duration_s = scan.time_increment_s * std::max(static_cast<double>(scan.ranges_m.size()) - 1.0, 0.0);
  const bool timed = duration_s > 0.0 && duration_s <= kMaxScanDuration_s;
  const double sense = upside_down ? -1.0 : 1.0;
  PlanarScan planar;
  planar.utime = scan.utime + (timed ? std::llround(duration_s * 1e6) : 0);
  planar.beams.reserve(scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) {
    const auto i = static_cast<double>(planar.beams.size());
    const double angle_rad = scan.angle_min_rad + i * scan.angle_increment_rad;
    const double dt_s = timed ? i * scan.time_increment_s - duration_s : 0.0;
    const bool seen = range_m >= scan.range_min_m && range_m <= scan.range_max_m;
    planar.beams.push_back(
        {seen ? range_m : 0.0F, static_cast<float>(sense * angle_rad), static_cast<int32_t>(std::llround(dt_s * 1e6))});
  }
  return planar;
}

}  // namespace lcmslam
