#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/pose3.h"

namespace lcmslam {

// Writes what ROS serializes: little-endian numbers, counted strings and arrays.
class RosBytes {
 public:
  template <class Number>
  RosBytes& Put(Number value) {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    data_.append(bytes, sizeof value);
    return *this;
  }
  RosBytes& PutRaw(const std::string& bytes) {
    data_ += bytes;
    return *this;
  }
  RosBytes& PutString(const std::string& text) { return Put(static_cast<uint32_t>(text.size())).PutRaw(text); }
  RosBytes& PutFloats(const std::vector<float>& values) {
    Put(static_cast<uint32_t>(values.size()));
    for (const float value : values) Put(value);
    return *this;
  }
  RosBytes& PutTime(int64_t utime) {
    return Put(static_cast<uint32_t>(utime / 1'000'000)).Put(static_cast<uint32_t>(utime % 1'000'000 * 1000));
  }
  RosBytes& PutHeader(int64_t utime, const std::string& frame) {
    return Put(uint32_t{0}).PutTime(utime).PutString(frame);
  }
  RosBytes& PutPose(const Pose3& pose) {
    for (const double value : {pose.translation.x(), pose.translation.y(), pose.translation.z(), pose.rotation.x(),
                               pose.rotation.y(), pose.rotation.z(), pose.rotation.w()}) {
      Put(value);
    }
    return *this;
  }

  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

inline std::string RosLaserScanBytes(int64_t utime, const std::string& frame, float angle_min_rad, float increment_rad,
                                     float time_increment_s, const std::vector<float>& ranges_m) {
  return RosBytes()
      .PutHeader(utime, frame)
      .Put(angle_min_rad)
      .Put(angle_min_rad + increment_rad * static_cast<float>(ranges_m.size()))
      .Put(increment_rad)
      .Put(time_increment_s)
      .Put(0.1F)   // scan_time
      .Put(0.05F)  // range_min
      .Put(20.0F)  // range_max
      .PutFloats(ranges_m)
      .PutFloats({})
      .data();
}

// A field of a sensor_msgs/PointCloud2 that is one number.
struct RosField {
  enum Type : uint8_t { kUint8 = 2, kUint16 = 4, kInt32 = 5, kUint32 = 6, kFloat32 = 7, kFloat64 = 8 };
  std::string name;
  uint32_t offset = 0;
  Type type = kFloat32;
};

// `points` are rows of point_bytes in one line.
inline std::string RosPointCloudBytes(int64_t utime, const std::string& frame, const std::vector<RosField>& fields,
                                      uint32_t point_bytes, const std::string& points) {
  RosBytes bytes;
  const auto count = static_cast<uint32_t>(points.size()) / point_bytes;
  bytes.PutHeader(utime, frame).Put(uint32_t{1}).Put(count).Put(static_cast<uint32_t>(fields.size()));
  for (const RosField& field : fields)
    bytes.PutString(field.name).Put(field.offset).Put(static_cast<uint8_t>(field.type)).Put(uint32_t{1});
  bytes.Put(uint8_t{0}).Put(point_bytes).Put(count * point_bytes).PutString(points).Put(uint8_t{1});
  return bytes.data();
}

inline std::string RosImuBytes(int64_t utime, const std::string& frame, const Eigen::Vector3d& angular_velocity,
                               const Eigen::Vector3d& acceleration) {
  const std::string covariance(9 * sizeof(double), '\0');
  RosBytes bytes;
  bytes.PutHeader(utime, frame).PutRaw(std::string(4 * sizeof(double), '\0')).PutRaw(covariance);
  for (const double value : angular_velocity) bytes.Put(value);
  bytes.PutRaw(covariance);
  for (const double value : acceleration) bytes.Put(value);
  return bytes.PutRaw(covariance).data();
}

inline std::string RosPoseStampedBytes(int64_t utime, const Pose3& pose) {
  return RosBytes().PutHeader(utime, "map").PutPose(pose).data();
}

inline std::string RosTransformBytes(int64_t utime, const std::string& parent, const std::string& child,
                                     const Pose3& T_parent_child) {
  return RosBytes().Put(uint32_t{1}).PutHeader(utime, parent).PutString(child).PutPose(T_parent_child).data();
}

inline std::string RosOdometryBytes(int64_t utime, const std::string& child, const Pose3& pose) {
  constexpr size_t kCovariancesAndTwist = (36 + 6 + 36) * sizeof(double);
  return RosBytes()
      .PutHeader(utime, "odom")
      .PutString(child)
      .PutPose(pose)
      .PutRaw(std::string(kCovariancesAndTwist, '\0'))
      .data();
}

}  // namespace lcmslam
