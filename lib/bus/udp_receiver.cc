#include "bus/udp_receiver.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "bus/clock.h"
#include "bus/errors.h"

namespace lcmslam {
namespace {

constexpr size_t kMaxDatagramBytes = 65'536;
constexpr int kOn = 1;

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

UdpReceiver::UdpReceiver(const UdpPort& port)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), port_(port.number), buffer_(kMaxDatagramBytes) {
  Check(socket_);
  try {
    Open(port);
  } catch (const CommandError&) {
    close(socket_);
    throw;
  }
}

void UdpReceiver::Open(const UdpPort& port) {
  if (port.buffer_bytes > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &port.buffer_bytes, sizeof port.buffer_bytes);
  Check(setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMP, &kOn, sizeof kOn));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port.number);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  if (!port.multicast_group.empty()) {
    ip_mreq group{};
    inet_pton(AF_INET, port.multicast_group.c_str(), &group.imr_multiaddr);
    address.sin_addr = group.imr_multiaddr;
    Check(setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &kOn, sizeof kOn));
    Check(setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group));
  }
  socklen_t size = sizeof address;
  auto* const any_address = reinterpret_cast<sockaddr*>(&address);
  Check(bind(socket_, any_address, size));
  Check(getsockname(socket_, any_address, &size));
  port_ = ntohs(address.sin_port);
}

UdpReceiver::~UdpReceiver() { close(socket_); }

void UdpReceiver::Check(int outcome) const {
  if (outcome < 0) throw CommandError(ExitCode::kRuntime, fmt::format("UDP port {}: {}", port_, std::strerror(errno)));
}

std::optional<ReceivedDatagram> UdpReceiver::Receive(std::chrono::milliseconds timeout) {
  pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
  const int ready = poll(&waiting, 1, static_cast<int>(timeout.count()));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return std::nullopt;
  Check(ready);
  sockaddr_in sender{};
  iovec payload{.iov_base = buffer_.data(), .iov_len = buffer_.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timeval))> notes{};
  msghdr message{};
  message.msg_name = &sender;
  message.msg_namelen = sizeof sender;
  message.msg_iov = &payload;
  message.msg_iovlen = 1;
  message.msg_control = notes.data();
  message.msg_controllen = notes.size();
  const ssize_t length = recvmsg(socket_, &message, MSG_DONTWAIT);
  if (length < 0 && (errno == EINTR || errno == EAGAIN)) return std::nullopt;
  Check(static_cast<int>(length));
  return ReceivedDatagram{{buffer_.data(), static_cast<size_t>(length)},
                          ArrivalUtime(message),
                          uint64_t{sender.sin_addr.s_addr} << 16 | sender.sin_port};
}

}  // namespace lcmslam
