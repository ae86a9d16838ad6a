#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "bus/wire.h"

namespace lcmslam {

// A message as LCM's UDP multicast carries it.
struct ChannelMessage {
  std::string channel;
  std::vector<uint8_t> data;
};

// Puts messages together from the datagrams of LCM's protocol, versions 1.0 to 1.5: a message that fits one datagram is
//   u32 "LC02", u32 sequence, channel, 0, data
// and a larger one comes in fragments, of which the first also names the channel:
//   u32 "LC03", u32 sequence, u32 data size, u32 offset, u16 fragment, u16 fragments, [channel, 0,] data
// all big-endian. Fragments may come in any order and may repeat. Memory stays bounded whatever arrives: of too many
// unfinished messages, or too many bytes of them, those begun first are given up on. One thread.
class DatagramAssembler {
 public:
  // The message that this datagram completes; `sender` tells senders apart. None, too, for what is not LCM's.
  [[nodiscard]] std::optional<ChannelMessage> Add(Bytes datagram, uint64_t sender);

  // Of what waits for fragments.
  size_t unfinished_bytes() const;

 private:
  struct Unfinished {
    uint64_t sender = 0;
    uint32_t sequence = 0;
    ChannelMessage message;  // the data grows as far as fragments reach
    uint32_t data_bytes = 0;
    std::vector<bool> arrived;  // by fragment
    size_t to_come = 0;
  };
  std::optional<ChannelMessage> AddFragment(Bytes datagram, uint64_t sender);
  Unfinished& MessageOf(uint64_t sender, uint32_t sequence, uint32_t data_bytes, size_t fragments);
  void LimitUnfinished();

  std::deque<Unfinished> unfinished_;  // in the order they began
};

}  // namespace lcmslam
