#include "bus/lcm_datagrams.h"

#include <algorithm>

namespace lcmslam {
namespace {

constexpr uint32_t kWholeMagic = 0x4c433032, kFragmentMagic = 0x4c433033;  // "LC02", "LC03"
constexpr size_t kWholeHeaderBytes = 8, kFragmentHeaderBytes = 20;
constexpr size_t kMaxChannelLength = 63;
constexpr size_t kMaxUnfinished = 100, kMaxUnfinishedBytes = 2 * kMaxMessageBytes;

uint32_t ReadU32(Bytes bytes, size_t at) {
  return uint32_t{bytes[at]} << 24 | uint32_t{bytes[at + 1]} << 16 | uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

size_t ReadU16(Bytes bytes, size_t at) { return size_t{bytes[at]} << 8 | bytes[at + 1]; }

// Takes the channel and its 0 off the front; none when that is not there.
std::optional<std::string> TakeChannel(Bytes& rest) {
  const auto end = std::ranges::find(rest, uint8_t{0});
  const auto length = static_cast<size_t>(end - rest.begin());
  if (end == rest.end() || length > kMaxChannelLength) return {};
  std::string channel(rest.begin(), end);
  rest = rest.subspan(length + 1);
  return channel;
}

}  // namespace

std::optional<ChannelMessage> DatagramAssembler::Add(Bytes datagram, uint64_t sender) {
  if (datagram.size() < kWholeHeaderBytes) return {};
  if (ReadU32(datagram, 0) == kFragmentMagic) return AddFragment(datagram, sender);
  if (ReadU32(datagram, 0) != kWholeMagic) return {};
  Bytes rest = datagram.subspan(kWholeHeaderBytes);
  std::optional<std::string> channel = TakeChannel(rest);
  if (!channel) return {};
  return ChannelMessage{std::move(*channel), {rest.begin(), rest.end()}};
}

std::optional<ChannelMessage> DatagramAssembler::AddFragment(Bytes datagram, uint64_t sender) {
  if (datagram.size() < kFragmentHeaderBytes) return {};
  const uint32_t sequence = ReadU32(datagram, 4), data_bytes = ReadU32(datagram, 8), offset = ReadU32(datagram, 12);
  const size_t fragment = ReadU16(datagram, 16), fragments = ReadU16(datagram, 18);
  Bytes rest = datagram.subspan(kFragmentHeaderBytes);
  std::optional<std::string> channel = fragment == 0 ? TakeChannel(rest) : "";
  if (!channel || fragment >= fragments || data_bytes > kMaxMessageBytes) return {};
  if (offset > data_bytes || rest.size() > data_bytes - offset) return {};

  Unfinished& unfinished = MessageOf(sender, sequence, data_bytes, fragments);
  if (unfinished.arrived[fragment]) return {};
  unfinished.arrived[fragment] = true;
  --unfinished.to_come;
  if (fragment == 0) unfinished.message.channel = std::move(*channel);
  std::vector<uint8_t>& data = unfinished.message.data;
  data.resize(std::max(data.size(), offset + rest.size()));
  std::ranges::copy(rest, data.begin() + offset);
  if (unfinished.to_come > 0) {
    LimitUnfinished();
    return {};
  }

  ChannelMessage message = std::move(unfinished.message);
  std::erase_if(unfinished_, [](const Unfinished& u) { return u.to_come == 0; });
  if (message.data.size() != data_bytes) return {};
  return message;
}

// The message that fragments with these numbers belong to, begun if it is new. A sender that began anew with the same
// sequence begins the message anew.
DatagramAssembler::Unfinished& DatagramAssembler::MessageOf(uint64_t sender, uint32_t sequence, uint32_t data_bytes,
                                                            size_t fragments) {
  const auto is_it = [&](const Unfinished& u) { return u.sender == sender && u.sequence == sequence; };
  const auto known = std::ranges::find_if(unfinished_, is_it);
  if (known != unfinished_.end()) {
    if (known->data_bytes == data_bytes && known->arrived.size() == fragments) return *known;
    unfinished_.erase(known);
  }
  unfinished_.push_back({sender, sequence, {}, data_bytes, std::vector<bool>(fragments), fragments});
  return unfinished_.back();
}

void DatagramAssembler::LimitUnfinished() {
  while (unfinished_.size() > kMaxUnfinished || unfinished_bytes() > kMaxUnfinishedBytes) unfinished_.pop_front();
}

size_t DatagramAssembler::unfinished_bytes() const {
  size_t bytes = 0;
  for (const Unfinished& unfinished : unfinished_) bytes += unfinished.message.data.size();
  return bytes;
}

}  // namespace lcmslam
