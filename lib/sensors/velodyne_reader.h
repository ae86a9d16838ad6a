#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "lidar/sweep.h"
#include "sensors/udp_capture.h"
#include "sensors/velodyne_assembler.h"

namespace lcmslam {

struct VelodyneReaderOptions {
  uint16_t port = 0;  // only datagrams to this port; 0: to any
};

// Reads the sweeps of a VLP-16 or HDL-32E from a capture (pcap, pcapng) or from a file of bare 1206-byte payloads,
// whose sweeps are stamped by the sensor's clock alone: microseconds after the full hour. Sweeps that are cut off by
// either end of the file are left out. Throws BadInput with the file's name when it is neither, or ends in the middle
// of a packet. One thread.
class VelodyneReader {
 public:
  explicit VelodyneReader(const std::filesystem::path& path, const VelodyneReaderOptions& options = {});

  // None at the end.
  [[nodiscard]] std::optional<Sweep> Next();

  int64_t packets() const { return packets_; }  // decoded so far
  int64_t refused() const { return refused_; }  // of a data packet's size, but not to be decoded

 private:
  struct Payload {
    std::span<const uint8_t> bytes;
    std::optional<int64_t> received_utime;
  };
  std::optional<Payload> NextPayload();
  std::optional<Payload> NextCaptured();
  std::optional<Payload> NextBare();

  std::filesystem::path path_;
  VelodyneReaderOptions options_;
  std::optional<UdpCaptureReader> capture_;
  std::ifstream bare_;
  std::vector<uint8_t> bare_payload_;
  VelodyneAssembler assembler_;
  std::deque<Sweep> ready_;
  int64_t packets_ = 0;
  int64_t refused_ = 0;
};

}  // namespace lcmslam
