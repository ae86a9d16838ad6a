#include "sensor-bridge/byte_link.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "bus/errors.h"

namespace lcmslam {

ByteLink::ByteLink(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

ByteLink::ByteLink(ByteLink&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), name_(std::move(other.name_)) {}

ByteLink::~ByteLink() {
  if (descriptor_ >= 0) close(descriptor_);
}

ByteLink ByteLink::Tcp(const std::string& host, uint16_t port) {
  const std::string name = fmt::format("{}:{}", host, port);
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  if (error != 0) ByteLink(-1, name).Fail(gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
  std::signal(SIGPIPE, SIG_IGN);  // a sensor that went away is an error like others
  ByteLink link(socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0), name);
  if (link.descriptor_ < 0 || connect(link.descriptor_, found->ai_addr, found->ai_addrlen) != 0)
    link.Fail(std::strerror(errno));
  return link;
}

ByteLink ByteLink::Serial(const std::string& device) {
  ByteLink link(open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), device);
  termios settings{};
  if (link.descriptor_ < 0 || tcgetattr(link.descriptor_, &settings) != 0) link.Fail(std::strerror(errno));
  cfmakeraw(&settings);
  if (tcsetattr(link.descriptor_, TCSANOW, &settings) != 0) link.Fail(std::strerror(errno));
  return link;
}

void ByteLink::Send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = write(descriptor_, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) Fail(std::strerror(errno));
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
}

std::string ByteLink::Receive(std::chrono::milliseconds timeout) {
  pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
  const int ready = poll(&waiting, 1, static_cast<int>(timeout.count()));
  if (ready < 0 && errno != EINTR) Fail(std::strerror(errno));
  if (ready <= 0) return "";
  std::array<char, 4096> buffer;
  const ssize_t length = read(descriptor_, buffer.data(), buffer.size());
  if (length < 0 && errno == EINTR) return "";
  if (length < 0) Fail(std::strerror(errno));
  if (length == 0) Fail("closed by the other side");
  return {buffer.data(), static_cast<size_t>(length)};
}

void ByteLink::Fail(const std::string& reason) const {
  throw CommandError(ExitCode::kRuntime, fmt::format("{}: {}", name_, reason));
}

}  // namespace lcmslam
