#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

struct pcap;

namespace lcmslam {

struct UdpDatagram {
  int64_t received_utime = 0;  // us
  uint16_t source_port = 0;
  uint16_t destination_port = 0;
  std::span<const uint8_t> payload;  // valid until the next call
};

// Reads the UDP datagrams of a capture (pcap or pcapng; Ethernet, Linux cooked or raw IP, IPv4), one after the other.
// Whatever else it holds is passed over, as are fragments. Throws BadInput with the file's name when it is no capture,
// of another link layer, or damaged. One thread.
class UdpCaptureReader {
 public:
  explicit UdpCaptureReader(const std::filesystem::path& path);

  // None at the end.
  [[nodiscard]] std::optional<UdpDatagram> Next();

 private:
  std::filesystem::path path_;
  std::unique_ptr<pcap, void (*)(pcap*)> capture_;
};

}  // namespace lcmslam
