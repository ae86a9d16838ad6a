#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace lcmslam {

// Bytes to and from a sensor, over TCP or a serial line. Throws CommandError (kRuntime) where it cannot be reached or
// breaks off. One thread.
class ByteLink {
 public:
  static ByteLink Tcp(const std::string& host, uint16_t port);
  // A serial device in raw mode; the speed stays as it is, USB devices have none.
  static ByteLink Serial(const std::string& device);
  ~ByteLink();
  ByteLink(ByteLink&& other) noexcept;
  ByteLink& operator=(ByteLink&&) = delete;

  void Send(std::string_view bytes);
  // What has come; "" when nothing does in time, or a signal does.
  [[nodiscard]] std::string Receive(std::chrono::milliseconds timeout);

 private:
  ByteLink(int descriptor, std::string name);
  [[noreturn]] void Fail(const std::string& reason) const;

  int descriptor_;
  std::string name_;
};

}  // namespace lcmslam
