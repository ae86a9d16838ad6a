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
