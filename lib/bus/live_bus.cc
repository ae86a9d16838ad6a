#include "bus/live_bus.h"

#include <algorithm>
#include <cstdlib>
#include <regex>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>
#include <netdb.h>
#include <unistd.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152";
constexpr milliseconds kReceiveTimeout{20};
constexpr milliseconds kHoldUp{100};       // a thread that is ready to run waits no longer
constexpr milliseconds kBacklog{100};      // what came meanwhile has then been read
constexpr milliseconds kQuiet{100};        // no message for this long: the bus is drained
constexpr milliseconds kDrainLimit{2000};  // a bus that never falls silent

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

// liblcm falls back silently on bad addresses and aborts when no tcpq server answers, so look first.
void CheckUrl(const std::string& url) {
  static const std::regex pattern(
      R"((udpm|tcpq|memq|file)://([^:?/]*)(:([0-9]+))?([^?]*)(\?[A-Za-z_]+=[^&?]*(&[A-Za-z_]+=[^&?]*)*)?)");
  std::smatch part;
  const auto refuse = [&](const char* why) {
    throw CommandError(ExitCode::kUsage, fmt::format("LCM URL '{}': {}", url, why));
  };
  if (!std::regex_match(url, part, pattern))
    refuse("not of the form udpm://ADDRESS:PORT?ttl=N, tcpq://HOST:PORT, memq:// or file://PATH");
  const std::string scheme = part[1], host = part[2], port = part[4];
  if (!port.empty() && (port.size() > 5 || std::stoi(port) < 1 || std::stoi(port) > 65535))
    refuse("port not in 1..65535");
  if (scheme == "udpm" && !host.empty() && !IsMulticast(host))
    refuse("not a multicast address (224.0.0.0 to 239.255.255.255)");
  if (scheme == "tcpq" && !CanConnect(host.empty() ? "localhost" : host, port.empty() ? "7700" : port)) {
    throw CommandError(ExitCode::kRuntime, fmt::format("LCM URL '{}': no tcpq server answers", url));
  }
}

}  // namespace

int64_t WallClockUtime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

LiveBus::LiveBus(const std::string& url) : url_(Resolve(url)) {
  CheckUrl(url_);
  lcm_ = std::make_unique<lcm::LCM>(url_);
  if (!lcm_->good())
    throw CommandError(ExitCode::kRuntime,
                       fmt::format("LCM URL '{}': the bus cannot be opened (is there a multicast route?)", url_));
}

LiveBus::~LiveBus() = default;

void LiveBus::Publish(const std::string& channel, Bytes data) {
  if (lcm_->publish(channel, data.data(), static_cast<unsigned>(data.size())) != 0) {
    throw CommandError(ExitCode::kRuntime,
                       fmt::format("LCM URL '{}': publishing {} bytes on {} failed", url_, data.size(), channel));
  }
}

LiveReceiver::LiveReceiver(LiveBus& bus, const std::string& channels, size_t capacity_messages)
    : bus_(bus), capacity_(capacity_messages) {
  struct Callback {
    static void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel, LiveReceiver* self) {
      const auto* data = static_cast<const uint8_t*>(buffer->data);
      const std::lock_guard lock(self->mutex_);
      if (self->queue_.size() >= self->capacity_) {
        ++self->dropped_;
        return;
      }
      self->queue_.push_back({self->ArrivalUtime(buffer->recv_utime), channel, {data, data + buffer->data_size}});
      self->arrived_.notify_one();
    }
  };
  auto* subscription = bus_.lcm().subscribeFunction("(" + channels + ")", &Callback::OnMessage, this);
  if (subscription == nullptr)
    throw CommandError(ExitCode::kRuntime, fmt::format("LCM URL '{}': cannot subscribe", bus_.url()));
  subscription->setQueueCapacity(0);  // unlimited: this thread takes messages out as they come
  thread_ = std::thread([this] { Receive(); });
}

LiveReceiver::~LiveReceiver() {
  Drain();
  thread_.join();
}

// liblcm 1.3.1 has the kernel's time of arrival only for buffers that it uses for the first time, else the time when it
// read the message. The two differ when this process was kept from running: then a message may be as old as the
// hold-up.
int64_t LiveReceiver::ArrivalUtime(int64_t read_utime) {
  const auto now = steady_clock::now();
  if (now - turn_ > kReceiveTimeout + kHoldUp) {
    hold_up_utime_ = WallClockUtime() - std::chrono::duration_cast<std::chrono::microseconds>(now - turn_).count();
    backlog_end_ = now + kBacklog;
  }
  return now < backlog_end_ ? std::min(read_utime, hold_up_utime_) : read_utime;
}

void LiveReceiver::Receive() {
  auto last_message = steady_clock::now();
  std::optional<steady_clock::time_point> drain_start;
  while (true) {
    turn_ = steady_clock::now();
    const int handled = bus_.lcm().handleTimeout(static_cast<int>(kReceiveTimeout.count()));
    const auto now = steady_clock::now();
    if (handled > 0) last_message = now;
    const std::lock_guard lock(mutex_);
    if (draining_ && !drain_start) drain_start = now;
    if (handled < 0) failed_ = true;
    const bool quiet =
        drain_start && (now - std::max(last_message, *drain_start) > kQuiet || now - *drain_start > kDrainLimit);
    if (handled < 0 || quiet) {
      done_ = true;
      arrived_.notify_one();
      return;
    }
  }
}

std::optional<Event> LiveReceiver::Pop(milliseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, timeout, [&] { return !queue_.empty() || done_; });
  if (queue_.empty()) return {};
  Event event = std::move(queue_.front());
  queue_.pop_front();
  return event;
}

void LiveReceiver::Drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

bool LiveReceiver::drained() const {
  const std::lock_guard lock(mutex_);
  return done_ && queue_.empty();
}

int64_t LiveReceiver::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

bool LiveReceiver::failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

}  // namespace lcmslam
