#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>

#include "lidar/sweep.h"
#include "sensors/velodyne_decoder.h"
#include "sensors/velodyne_payloads.h"

namespace lcmslam {

// Reads the sweeps of a VLP-16 or HDL-32E from a capture or a file of bare payloads. Sweeps that are cut off by either
// end of the file are left out. Throws BadInput as VelodynePayloadReader does. One thread.
class VelodyneReader {
 public:
  // `port`: only datagrams to this one; 0: to any.
  explicit VelodyneReader(const std::filesystem::path& path, uint16_t port = 0) : payloads_(path, port) {}

  // None at the end.
  [[nodiscard]] std::optional<Sweep> Next();

  int64_t packets() const { return decoder_.packets(); }  // decoded so far
  int64_t refused() const { return decoder_.refused(); }  // of a data packet's size, but not to be decoded

 private:
  VelodynePayloadReader payloads_;
  VelodyneDecoder decoder_;
  std::deque<Sweep> ready_;
};

}  // namespace lcmslam
