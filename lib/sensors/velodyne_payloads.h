#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <vector>

#include "sensors/udp_capture.h"

namespace lcmslam {

// What a Velodyne sent in one datagram.
struct VelodynePayload {
  std::span<const uint8_t> bytes;         // valid until the next call
  std::optional<int64_t> received_utime;  // us; none: the file does not say
  uint16_t port = 0;                      // it was sent to; 0: unknown
};

// Takes data packets out of a capture (pcap, pcapng) or a file of bare 1206-byte payloads. Throws BadInput with the
// file's name when it is neither, or ends in the middle of a packet. One thread.
class VelodynePayloadReader {
 public:
  // `port`: only datagrams to this one; 0: to any.
  explicit VelodynePayloadReader(const std::filesystem::path& path, uint16_t port = 0);

  // None at the end.
  [[nodiscard]] std::optional<VelodynePayload> Next();

 private:
  std::optional<VelodynePayload> NextCaptured();
  std::optional<VelodynePayload> NextBare();

  std::filesystem::path path_;
  uint16_t port_;
  std::optional<UdpCaptureReader> capture_;
  std::ifstream bare_;
  std::vector<uint8_t> bare_payload_;
};

}  // namespace lcmslam
