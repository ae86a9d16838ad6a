#include "sensor-bridge/udp_receiver.h"

#include <cerrno>
#include <cstring>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "bus/errors.h"
#include "bus/live_bus.h"

namespace lcmslam {
namespace {

constexpr int kBufferBytes = 4 << 20;  // as much of it as the kernel allows
constexpr int kOn = 1;

[[noreturn]] void Fail(uint16_t port) {
  throw CommandError(ExitCode::kRuntime, fmt::format("UDP port {}: {}", port, std::strerror(errno)));
}

// When the kernel took the datagram in (SO_TIMESTAMP).
int64_t ArrivalUtime(msghdr& message) {
  for (cmsghdr* note = CMSG_FIRSTHDR(&message); note != nullptr; note = CMSG_NXTHDR(&message, note)) {
    if (note->cmsg_level != SOL_SOCKET || note->cmsg_type != SCM_TIMESTAMP) continue;
    timeval time{};
    std::memcpy(&time, CMSG_DATA(note), sizeof time);
    return int64_t{time.tv_sec} * 1'000'000 + time.tv_usec;
  }
  return WallClockUtime();
}

}  // namespace

UdpReceiver::UdpReceiver(uint16_t port) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), port_(port) {
  if (socket_ < 0) Fail(port);
  setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kBufferBytes, sizeof kBufferBytes);
  setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMP, &kOn, sizeof kOn);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  socklen_t size = sizeof address;
  auto* const any_address = reinterpret_cast<sockaddr*>(&address);
  if (bind(socket_, any_address, size) < 0 || getsockname(socket_, any_address, &size) < 0) {
    const int reason = errno;
    close(socket_);
    errno = reason;
    Fail(port);
  }
  port_ = ntohs(address.sin_port);
}

UdpReceiver::~UdpReceiver() { close(socket_); }

std::optional<ReceivedDatagram> UdpReceiver::Receive(std::chrono::milliseconds timeout) {
  pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
  const int ready = poll(&waiting, 1, static_cast<int>(timeout.count()));
  if (ready < 0 && errno != EINTR) Fail(port_);
  if (ready <= 0) return std::nullopt;
  iovec payload{.iov_base = buffer_.data(), .iov_len = buffer_.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timeval))> notes{};
  msghdr message{};
  message.msg_iov = &payload;
  message.msg_iovlen = 1;
  message.msg_control = notes.data();
  message.msg_controllen = notes.size();
  const ssize_t length = recvmsg(socket_, &message, 0);
  if (length < 0 && errno != EINTR && errno != EAGAIN) Fail(port_);
  if (length < 0) return std::nullopt;
  return ReceivedDatagram{{buffer_.data(), static_cast<size_t>(length)}, ArrivalUtime(message)};
}

}  // namespace lcmslam
