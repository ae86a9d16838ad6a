#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lcmslam {

struct UdpPort {
  uint16_t number = 0;            // 0: a free one
  std::string multicast_group{};  // "": none; else the port is shared, and nothing sent elsewhere is heard
  int buffer_bytes = 0;           // as much of it as the kernel allows; 0: the kernel's default
};

struct ReceivedDatagram {
  std::span<const uint8_t> payload;  // valid until the next call
  int64_t received_utime = 0;        // us, by this host's clock; when it arrived, not when it was read
  uint64_t sender = 0;               // its address and port
};

// Hears one UDP port on all interfaces (IPv4). Throws CommandError (kRuntime) where the port is taken or the network
// fails. One thread.
class UdpReceiver {
 public:
  explicit UdpReceiver(const UdpPort& port);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  uint16_t port() const { return port_; }
  // None when nothing comes in time, or a signal does.
  [[nodiscard]] std::optional<ReceivedDatagram> Receive(std::chrono::milliseconds timeout);

 private:
  void Open(const UdpPort& port);
  void Check(int outcome) const;

  int socket_;
  uint16_t port_ = 0;
  std::vector<uint8_t> buffer_;
};

}  // namespace lcmslam
