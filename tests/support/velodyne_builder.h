#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lcmslam {

// The bytes of a Velodyne data packet, field by field.
struct VelodyneBuilder {
  static constexpr uint8_t kStrongest = 0x37, kDual = 0x39, kHdl32e = 0x21, kVlp16 = 0x22;

  std::array<uint16_t, 12> azimuths{};                // 0.01 degrees
  std::array<std::array<uint16_t, 32>, 12> ranges{};  // 2 mm
  std::array<std::array<uint8_t, 32>, 12> intensities{};
  uint32_t stamp_us = 0;
  uint8_t mode = kStrongest;
  uint8_t product = kVlp16;

  std::vector<uint8_t> Bytes() const {
    std::vector<uint8_t> bytes;
    const auto put16 = [&](uint16_t value) {
      bytes.push_back(static_cast<uint8_t>(value));
      bytes.push_back(static_cast<uint8_t>(value >> 8));
    };
    for (size_t b = 0; b < 12; ++b) {
      put16(0xEEFF);
      put16(azimuths[b]);
      for (size_t i = 0; i < 32; ++i) {
        put16(ranges[b][i]);
        bytes.push_back(intensities[b][i]);
      }
    }
    put16(static_cast<uint16_t>(stamp_us));
    put16(static_cast<uint16_t>(stamp_us >> 16));
    bytes.push_back(mode);
    bytes.push_back(product);
    return bytes;
  }
};

}  // namespace lcmslam
