#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "sensors/bad_input.h"

namespace lcmslam {

// Walks over little-endian bytes; throws BadInput instead of leaving them.
class ByteReader {
 public:
  explicit ByteReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  std::span<const uint8_t> Take(size_t count) {
    if (count > bytes_.size()) throw BadInput("shorter than its contents say");
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> Number Get() {
    static_assert(std::endian::native == std::endian::little);
    Number value;
    std::memcpy(&value, Take(sizeof value).data(), sizeof value);
    return value;
  }
  // What the log formats of ROS call a string or an array: a 32-bit count, then the elements.
  std::span<const uint8_t> GetSized(size_t element_bytes = 1) {
    const uint64_t count = Get<uint32_t>();
    return Take(static_cast<size_t>(count * element_bytes));
  }
  std::string GetString() {
    const auto characters = GetSized();
    return {characters.begin(), characters.end()};
  }

  bool empty() const { return bytes_.empty(); }
  size_t size() const { return bytes_.size(); }

 private:
  std::span<const uint8_t> bytes_;
};

}  // namespace lcmslam
