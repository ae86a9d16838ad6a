#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lcmslam {

using Bytes = std::span<const uint8_t>;

// The largest message looked at; anything larger is refused.
inline constexpr size_t kMaxMessageBytes = size_t{16} << 20;

// What lcm-gen generates.
template <class M>
concept LcmMessage = requires(M m, const M c, void* out, const void* in) {
  { M::getHash() } -> std::convertible_to<int64_t>;
  { c.encode(out, 0, 0) } -> std::convertible_to<int>;
  { m.decode(in, 0, 0) } -> std::convertible_to<int>;
};

// The type's fingerprint; names of type and package do not enter it, so equal fields are equal types. 0: too short.
int64_t Fingerprint(Bytes message);

// True when every count and string length of a message of type M agrees with the bytes that are there, to the last one.
// Generated decoders trust the counts: they allocate gigabytes or throw on a bad one.
template <LcmMessage M>
bool LayoutFits(Bytes message);

// The message, or none when it is not a well-formed M. Never throws on bad bytes. Any thread.
template <LcmMessage M>
std::optional<M> Decode(Bytes message) {
  if (message.size() > kMaxMessageBytes || Fingerprint(message) != M::getHash() || !LayoutFits<M>(message)) return {};
  M decoded{};
  const int length = decoded.decode(message.data(), 0, static_cast<int>(message.size()));
  if (length != static_cast<int>(message.size())) return {};
  return decoded;
}

// `message`'s counts must agree with its arrays.
template <LcmMessage M>
std::vector<uint8_t> Encode(const M& message) {
  std::vector<uint8_t> bytes(static_cast<size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace lcmslam
