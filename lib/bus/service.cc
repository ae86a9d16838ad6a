#include "bus/service.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <lcmslam/service_status_t.hpp>

namespace lcmslam {
namespace {

std::string StatusChannel(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return c == '-' ? '_' : std::toupper(c); });
  return name + "_STATUS";
}

}  // namespace

ServiceContext::ServiceContext(std::string name, RunOptions options)
    : options_(std::move(options)), status_channel_(StatusChannel(name)), health_(std::move(name)) {}

void ServiceContext::Subscribe(const std::string& channel_pattern, Handler handler) {
  try {
    subscriptions_.push_back(
        std::make_unique<Subscription>(std::regex(channel_pattern, std::regex::extended), std::move(handler)));
  } catch (const std::regex_error&) {
    throw CommandError(ExitCode::kUsage, "channel '" + channel_pattern + "': not a regular expression");
  }
  channels_ += (channels_.empty() ? "(" : "|(") + channel_pattern + ")";
  by_channel_.clear();
}

void ServiceContext::EverySecond(std::function<void(int64_t)> handler) { every_second_.push_back(std::move(handler)); }

void ServiceContext::Publish(const std::string& channel, Bytes data) { sink_(now_utime_, channel, data); }

const std::vector<const ServiceContext::Subscription*>& ServiceContext::SubscriptionsTo(const std::string& channel) {
  const auto [known, is_new] = by_channel_.try_emplace(channel);
  if (is_new) {
    for (const auto& subscription : subscriptions_) {
      if (std::regex_match(channel, subscription->pattern)) known->second.push_back(subscription.get());
    }
  }
  return known->second;
}

void ServiceContext::Dispatch(const Event& event, double waited_ms) {
  using Clock = std::chrono::steady_clock;
  now_utime_ = event.utime;
  health_.BeginEvent(event.utime, event.utime + std::llround(1e3 * waited_ms));
  for (const Subscription* subscription : SubscriptionsTo(event.channel)) {
    const Clock::time_point start = Clock::now();
    const Handled handled = subscription->handler(event);
    if (handled == Handled::kIgnored) continue;
    health_.CountReceived();
    if (handled == Handled::kRefused) {
      health_.CountRefused();
      continue;
    }
    health_.CountProcessed();
    const double busy_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    health_.NoteLatency(waited_ms + busy_ms, busy_ms);
  }
}

void ServiceContext::Tick(int64_t now_utime) {
  now_utime_ = now_utime;
  for (const auto& handler : every_second_) handler(now_utime);
  Publish(status_channel_, health_.Report(now_utime, wall_clock()));
}

}  // namespace lcmslam
