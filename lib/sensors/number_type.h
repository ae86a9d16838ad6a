#pragma once

#include <cstdint>
#include <span>

namespace lcmslam {

// How a file of points stores one number.
struct NumberType {
  enum class Kind { kSigned, kUnsigned, kFloat };
  Kind kind = Kind::kFloat;
  size_t bytes = 4;

  // Integers of 1, 2, 4, 8 bytes, floats of 4, 8.
  bool IsKnown() const;
};

// `bytes` holds exactly type.bytes; the type is known. Large 64-bit integers are rounded. Pure.
[[nodiscard]] double ReadNumber(std::span<const uint8_t> bytes, const NumberType& type, bool big_endian);

}  // namespace lcmslam
