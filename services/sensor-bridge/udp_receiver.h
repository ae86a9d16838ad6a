#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

namespace lcmslam {

struct ReceivedDatagram {
  std::span<const uint8_t> payload;  // valid until the next call
  int64_t received_utime = 0;        // us, by this host's clock; when it arrived, not when it was read
};

// Hears one UDP port on all interfaces (IPv4). Throws CommandError (kRuntime) where the port is taken or the network
// fails. One thread.
class UdpReceiver {
 public:
  explicit UdpReceiver(uint16_t port);  // 0: a free one
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  uint16_t port() const { return port_; }
  // None when nothing comes in time, or a signal does. What is longer than an Ethernet frame is cut.
  [[nodiscard]] std::optional<ReceivedDatagram> Receive(std::chrono::milliseconds timeout);

 private:
  int socket_;
  uint16_t port_ = 0;
  std::array<uint8_t, 1500> buffer_;
};

}  // namespace lcmslam
