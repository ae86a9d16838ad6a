#include "bus/message_source.h"

#include <regex>
#include <unordered_map>

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include "bus/errors.h"
#include "bus/lcm_datagrams.h"
#include "bus/live_bus.h"
#include "bus/udp_receiver.h"

namespace lcmslam {
namespace {

UdpPort PortOf(const LcmUrl& url) {
  const std::string buffer_bytes = url.Option("recv_buf_size");
  return {static_cast<uint16_t>(std::stoi(url.port)), url.host, std::atoi(buffer_bytes.c_str())};
}

// Whether a channel's whole name matches; remembers the names it has seen.
class ChannelFilter {
 public:
  explicit ChannelFilter(const std::string& channels) : pattern_(channels, std::regex::extended) {}

  bool Admits(const std::string& channel) {
    if (known_.size() > kMaxKnown) known_.clear();
    const auto [known, is_new] = known_.try_emplace(channel);
    if (is_new) known->second = std::regex_match(channel, pattern_);
    return known->second;
  }

 private:
  static constexpr size_t kMaxKnown = 1000;
  std::regex pattern_;
  std::unordered_map<std::string, bool> known_;
};

class UdpSource : public MessageSource {
 public:
  UdpSource(const LcmUrl& url, const std::string& channels) : receiver_(PortOf(url)), filter_(channels) {}

  std::optional<Event> Next(std::chrono::milliseconds timeout) override {
    const std::optional<ReceivedDatagram> datagram = receiver_.Receive(timeout);
    if (!datagram) return {};
    std::optional<ChannelMessage> message = assembler_.Add(datagram->payload, datagram->sender);
    if (!message || !filter_.Admits(message->channel)) return {};
    return Event{datagram->received_utime, std::move(message->channel), std::move(message->data)};
  }

 private:
  UdpReceiver receiver_;
  DatagramAssembler assembler_;
  ChannelFilter filter_;
};

class LcmSource : public MessageSource {
 public:
  LcmSource(LiveBus& bus, const std::string& channels) : bus_(bus) {
    if (bus_.lcm().subscribeFunction("(" + channels + ")", &OnMessage, this) == nullptr) Fail("cannot subscribe");
  }

  std::optional<Event> Next(std::chrono::milliseconds timeout) override {
    arrived_.reset();
    if (bus_.lcm().handleTimeout(static_cast<int>(timeout.count())) < 0) Fail("the connection broke");
    return std::move(arrived_);
  }

 private:
  static void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel, LcmSource* self) {
    const auto* data = static_cast<const uint8_t*>(buffer->data);
    self->arrived_ = Event{buffer->recv_utime, channel, {data, data + buffer->data_size}};
  }
  [[noreturn]] void Fail(const char* what) const {
    throw CommandError(ExitCode::kRuntime, fmt::format("LCM URL '{}': {}", bus_.url().text, what));
  }

  LiveBus& bus_;
  std::optional<Event> arrived_;
};

}  // namespace

std::unique_ptr<MessageSource> OpenMessageSource(LiveBus& bus, const std::string& channels) {
  if (bus.url().scheme == "udpm") return std::make_unique<UdpSource>(bus.url(), channels);
  return std::make_unique<LcmSource>(bus, channels);
}

}  // namespace lcmslam
