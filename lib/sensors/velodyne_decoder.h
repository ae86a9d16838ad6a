#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lidar/sweep.h"
#include "sensors/velodyne_assembler.h"

namespace lcmslam {

// From the payloads of one VLP-16 or HDL-32E to its sweeps; see VelodyneAssembler for their stamps. What cannot be
// decoded is counted and passed over. One thread.
class VelodyneDecoder {
 public:
  // The sweeps that this payload completes. Without received_utime, stamps are by the sensor's clock alone:
  // microseconds after the full hour.
  [[nodiscard]] std::vector<Sweep> Add(std::span<const uint8_t> payload, std::optional<int64_t> received_utime);

  int64_t packet_utime() const { return assembler_.packet_utime(); }  // of the last one decoded
  int64_t packets() const { return packets_; }                        // decoded so far
  int64_t refused() const { return refused_; }

 private:
  VelodyneAssembler assembler_;
  int64_t packets_ = 0;
  int64_t refused_ = 0;
};

}  // namespace lcmslam
