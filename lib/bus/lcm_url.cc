#include "bus/lcm_url.h"

#include <cstdlib>
#include <regex>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <unistd.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152";

std::string Resolve(const std::string& url) {
  if (!url.empty()) return url;
  const char* environment = std::getenv("LCM_DEFAULT_URL");
  return environment != nullptr && *environment != '\0' ? environment : kDefaultUrl;
}

bool IsMulticast(const std::string& address) {
  in_addr parsed{};
  return inet_pton(AF_INET, address.c_str(), &parsed) == 1 && IN_MULTICAST(ntohl(parsed.s_addr));
}

bool CanConnect(const std::string& host, const std::string& port) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) return false;
  bool connected = false;
  for (const addrinfo* a = found; a != nullptr && !connected; a = a->ai_next) {
    const int fd = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
    connected = fd >= 0 && connect(fd, a->ai_addr, a->ai_addrlen) == 0;
    if (fd >= 0) close(fd);
  }
  freeaddrinfo(found);
  return connected;
}

}  // namespace

std::string LcmUrl::Option(const std::string& name) const {
  const std::regex pattern("(^|&)" + name + "=([^&]*)");
  std::smatch found;
  return std::regex_search(options, found, pattern) ? found[2].str() : "";
}

LcmUrl CheckedLcmUrl(const std::string& text) {
  static const std::regex pattern(
      R"((udpm|tcpq|memq|file)://([^:?/]*)(?::([0-9]+))?([^?]*)(?:\?([A-Za-z_]+=[^&?]*(?:&[A-Za-z_]+=[^&?]*)*))?)");
  const std::string whole = Resolve(text);
  const auto refuse = [&](const char* why) {
    throw CommandError(ExitCode::kUsage, fmt::format("LCM URL '{}': {}", whole, why));
  };
  std::smatch part;
  if (!std::regex_match(whole, part, pattern))
    refuse("not of the form udpm://ADDRESS:PORT?ttl=N, tcpq://HOST:PORT, memq:// or file://PATH");
  LcmUrl url{whole, part[1], part[2], part[3], part[5]};
  if (!url.port.empty() && (url.port.size() > 5 || std::stoi(url.port) < 1 || std::stoi(url.port) > 65535))
    refuse("port not in 1..65535");
  if (url.scheme == "udpm") {
    if (url.host.empty()) url.host = "239.255.76.67";
    if (url.port.empty()) url.port = "7667";
    if (!IsMulticast(url.host)) refuse("not a multicast address (224.0.0.0 to 239.255.255.255)");
  }
  if (url.scheme == "tcpq" &&
      !CanConnect(url.host.empty() ? "localhost" : url.host, url.port.empty() ? "7700" : url.port)) {
    throw CommandError(ExitCode::kRuntime, fmt::format("LCM URL '{}': no tcpq server answers", whole));
  }
  return url;
}

}  // namespace lcmslam
