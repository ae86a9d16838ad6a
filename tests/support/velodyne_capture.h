#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/velodyne_builder.h"

namespace lcmslam {

// The payloads of a VLP-16 that sees 2 m all around, in packets of 5 degrees.
inline std::vector<std::string> VelodyneTurns(uint32_t turns) {
  std::vector<std::string> payloads;
  for (uint32_t i = 0; i < 72 * turns; ++i) {
    VelodyneBuilder builder;
    for (uint32_t b = 0; b < 12; ++b) builder.azimuths[b] = static_cast<uint16_t>((500 * i + 42 * b) % 36'000);
    for (auto& block : builder.ranges) block.fill(1000);
    builder.stamp_us = 1'000'000 + 1389 * i;
    const std::vector<uint8_t> bytes = builder.Bytes();
    payloads.emplace_back(bytes.begin(), bytes.end());
  }
  return payloads;
}

inline void PutNumber(std::string& bytes, uint64_t value, int count, bool network_order) {
  for (int i = 0; i < count; ++i) {
    const int shift = 8 * (network_order ? count - 1 - i : i);
    bytes.push_back(static_cast<char>(value >> shift));
  }
}

inline std::string UdpOverIp(const std::string& payload, uint16_t port, uint16_t fragment = 0) {
  std::string ip = "\x45" + std::string(1, '\0');
  PutNumber(ip, 28 + payload.size(), 2, true);
  PutNumber(ip, 0, 2, true);
  PutNumber(ip, fragment, 2, true);
  ip += "\x40\x11" + std::string(10, '\0');
  for (const uint64_t value : {uint64_t{2368}, uint64_t{port}, 8 + payload.size(), size_t{0}})
    PutNumber(ip, value, 2, true);
  return ip + payload;
}

inline std::string Ethernet(const std::string& ip, bool vlan = false) {
  return std::string(12, 'm') + (vlan ? std::string("\x81\0\0\x07", 4) : "") + std::string("\x08\0", 2) + ip;
}

// The bytes of a pcap file.
class CaptureBuilder {
 public:
  explicit CaptureBuilder(uint32_t link_type) {
    for (const uint64_t value : {0xA1B2C3D4U, 0x00040002U, 0U, 0U, 65535U, link_type})
      PutNumber(bytes_, value, 4, false);
  }
  void Frame(int64_t utime, const std::string& frame) {
    const auto bytes = frame.size();
    for (const uint64_t value : {static_cast<uint64_t>(utime / 1'000'000), static_cast<uint64_t>(utime % 1'000'000),
                                 uint64_t{bytes}, uint64_t{bytes}}) {
      PutNumber(bytes_, value, 4, false);
    }
    bytes_ += frame;
  }
  const std::string& Bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string Joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

inline std::string VelodyneCapture(const std::vector<std::string>& payloads, int64_t first_utime) {
  CaptureBuilder capture(1);
  int64_t utime = first_utime;
  for (const std::string& payload : payloads) capture.Frame(utime++, Ethernet(UdpOverIp(payload, 2368)));
  return capture.Bytes();
}

}  // namespace lcmslam
