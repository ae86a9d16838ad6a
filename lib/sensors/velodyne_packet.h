#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace lcmslam {

// One return, in the lidar's frame (x forward, y left, z up).
struct VelodynePoint {
  Eigen::Vector3f p_lidar;   // m
  float intensity = 0.0F;    // calibrated reflectivity, 0..255
  int16_t ring = 0;          // 0 lowest
  double azimuth_rad = 0.0;  // of the head, clockwise from x, in [0, 2 pi)
  double delay_us = 0.0;     // after the packet's stamp
};

struct VelodynePacket {
  uint32_t stamp_us = 0;              // of the first firing, after the full hour, by the sensor's clock
  std::vector<VelodynePoint> points;  // in the order of time; shots without return are left out
};

// The payload of one UDP packet of a Velodyne.
inline constexpr size_t kVelodynePacketBytes = 1206;

// Decodes a data packet of a VLP-16 or HDL-32E in any return mode; in dual mode a return that is both strongest and
// last comes once. Angles and times as in VelodyneVlp16(), VelodyneHdl32e(); the head is taken to turn evenly within
// the packet. Throws BadInput when the payload is not such a packet. Pure. VLP-16 User Manual 63-9243, chapter 9;
// HDL-32E User Manual 63-9113, appendix A.
[[nodiscard]] VelodynePacket DecodeVelodynePacket(std::span<const uint8_t> payload);

}  // namespace lcmslam
