#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sensor-bridge/sensor_publisher.h"
#include "sensors/velodyne_decoder.h"

namespace lcmslam {

// Publishes what a Velodyne sends: its sweeps on LIDAR_3D and, if wanted, its payloads on LIDAR_3D_PACKET.
class VelodyneBridge {
 public:
  VelodyneBridge(SensorPublisher& publisher, bool keep_packets) : publisher_(publisher), keep_packets_(keep_packets) {}

  // received_utime: none where nobody wrote it down; port: the payload was sent to, 0 unknown.
  void Add(std::span<const uint8_t> payload, std::optional<int64_t> received_utime, uint16_t port);

  int64_t sweeps() const { return sweeps_; }                                   // published
  int64_t packets() const { return decoder_.packets() + decoder_.refused(); }  // of a data packet's size
  int64_t refused() const { return decoder_.refused(); }                       // of these, not to be decoded
  int64_t packet_utime() const { return decoder_.packet_utime(); }  // by the sensor's clock, of the last one decoded
  // "293 packets, 2 of them not to be decoded".
  std::string Summary() const;

 private:
  SensorPublisher& publisher_;
  bool keep_packets_;
  VelodyneDecoder decoder_;
  int64_t sweeps_ = 0;
};

}  // namespace lcmslam
