#include "bus/wire.h"

#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/sdf_tile_t.hpp>
#include <lcmslam/service_status_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>
#include <lcmslam/surfel_chunk_t.hpp>

namespace lcmslam {
namespace {

// Big-endian integers as LCM writes them.
uint64_t ReadBigEndian(const uint8_t* bytes, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value = value << 8 | bytes[i];
  return value;
}

// Walks over a message without building it. Once something does not fit, nothing does.
class Walker {
 public:
  explicit Walker(Bytes message) : rest_(message) { Skip(sizeof(int64_t)); }

  Walker& Skip(size_t bytes) {
    if (bytes > rest_.size()) {
      fits_ = false;
    } else {
      rest_ = rest_.subspan(bytes);
    }
    return *this;
  }

  // A count field of `size` bytes.
  size_t Count(size_t size = sizeof(int32_t)) {
    if (size > rest_.size()) {
      fits_ = false;
      return 0;
    }
    const uint64_t raw = ReadBigEndian(rest_.data(), size);
    Skip(size);
    const bool negative = (raw >> (8 * size - 1) & 1U) != 0;
    if (negative) fits_ = false;
    return negative ? 0 : static_cast<size_t>(raw);
  }

  Walker& Array(size_t count, size_t element_bytes) {
    if (count > rest_.size() / element_bytes) {
      fits_ = false;
      return *this;
    }
    return Skip(count * element_bytes);
  }

  // Length including the closing NUL, then the characters.
  Walker& String() {
    const size_t length = Count();
    if (length == 0 || length > rest_.size() || rest_[length - 1] != 0) {
      fits_ = false;
      return *this;
    }
    return Skip(length);
  }

  Walker& Strings(size_t count) {
    for (size_t i = 0; i < count && fits_; ++i) String();
    return *this;
  }

  bool AtEnd() const { return fits_ && rest_.empty(); }

 private:
  Bytes rest_;
  bool fits_ = true;
};

constexpr size_t k8 = 1, k16 = 2, k32 = 4, k64 = 8;

}  // namespace

int64_t Fingerprint(Bytes message) {
  return message.size() < k64 ? 0 : static_cast<int64_t>(ReadBigEndian(message.data(), k64));
}

// One layout a type, in the order of its .lcm file.

template <>
bool LayoutFits<planar_scan_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64).Count();
  return walk.Array(n, k32).Array(n, k32).Array(n, k64).Array(n, k32).AtEnd();
}

template <>
bool LayoutFits<planar_lidar_t>(Bytes message) {
  Walker walk(message);
  const size_t ranges = walk.Skip(k64).Count();
  const size_t intensities = walk.Array(ranges, k32).Count();
  return walk.Array(intensities, k32).Skip(2 * k32).AtEnd();
}

template <>
bool LayoutFits<pose_t>(Bytes message) {
  return Walker(message).Skip(k64 + 16 * k64).AtEnd();
}

template <>
bool LayoutFits<pose_xyt_t>(Bytes message) {
  return Walker(message).Skip(k64 + 3 * k32).AtEnd();
}

template <>
bool LayoutFits<rigid_transform_t>(Bytes message) {
  return Walker(message).Skip(k64 + 7 * k64).AtEnd();
}

template <>
bool LayoutFits<occupancy_grid_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64 + 3 * k32 + 2 * k32).Count();
  return walk.Array(n, k8).AtEnd();
}

template <>
bool LayoutFits<point_cloud_chunk_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64).Count();
  return walk.Skip(k32 + 2 * k16).Array(n, 4 * k32 + k16 + k32).AtEnd();
}

template <>
bool LayoutFits<lidar_packet_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64).Count();
  return walk.Skip(k32).Array(n, k8).AtEnd();
}

template <>
bool LayoutFits<imu_t>(Bytes message) {
  return Walker(message).Skip(k64 + 6 * k64).AtEnd();
}

template <>
bool LayoutFits<surfel_chunk_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64).Count();
  return walk.Skip(k32).Array(n, 9 * k32).AtEnd();
}

template <>
bool LayoutFits<sdf_tile_t>(Bytes message) {
  Walker walk(message);
  const size_t n = walk.Skip(k64).Count();
  return walk.Skip(3 * k32 + 2 * k32).Array(n, k16).Array(n, k8).AtEnd();
}

template <>
bool LayoutFits<slam_diagnostics_t>(Bytes message) {
  Walker walk(message);
  walk.Skip(k64 + k16);
  const size_t covariance = walk.Count(k16);
  const size_t stages = walk.Count(k16);
  walk.Skip(3 * k64 + k8 + 2 * k32 + 3 * k32);
  return walk.Array(covariance, k64).Skip(k32).Array(stages, k32).Strings(stages).AtEnd();
}

template <>
bool LayoutFits<slam_command_t>(Bytes message) {
  return Walker(message).Skip(k64 + k8 + 7 * k64).Strings(2).AtEnd();
}

template <>
bool LayoutFits<service_status_t>(Bytes message) {
  return Walker(message).Skip(8 * k64 + 5 * k32 + k8).Strings(2).AtEnd();
}

template <>
bool LayoutFits<evaluation_t>(Bytes message) {
  return Walker(message).Skip(3 * k64 + 6 * k64 + 7 * k64).Strings(4).AtEnd();
}

}  // namespace lcmslam
