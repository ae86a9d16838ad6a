#include "sensors/number_type.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace lcmslam {
namespace {

template <class Number>
double As(const std::array<uint8_t, 8>& little_endian) {
  static_assert(std::endian::native == std::endian::little);
  Number number;
  std::memcpy(&number, little_endian.data(), sizeof number);
  return static_cast<double>(number);
}

}  // namespace

bool NumberType::IsKnown() const {
  if (kind == Kind::kFloat) return bytes == 4 || bytes == 8;
  return bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8;
}

double ReadNumber(std::span<const uint8_t> bytes, const NumberType& type, bool big_endian) {
  std::array<uint8_t, 8> b{};
  std::ranges::copy(bytes.first(type.bytes), b.begin());
  if (big_endian) std::reverse(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(type.bytes));
  const bool is_signed = type.kind == NumberType::Kind::kSigned;
  if (type.kind == NumberType::Kind::kFloat) return type.bytes == 4 ? As<float>(b) : As<double>(b);
  switch (type.bytes) {
    case 1:
      return is_signed ? As<int8_t>(b) : As<uint8_t>(b);
    case 2:
      return is_signed ? As<int16_t>(b) : As<uint16_t>(b);
    case 4:
      return is_signed ? As<int32_t>(b) : As<uint32_t>(b);
    default:
      return is_signed ? As<int64_t>(b) : As<uint64_t>(b);
  }
}

}  // namespace lcmslam
