#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lcmslam {

// Unpack exactly `size` bytes; throw BadInput when the packed bytes are damaged or hold another number. No more memory
// is taken than the packed bytes fill. Pure.
[[nodiscard]] std::vector<uint8_t> UnpackBzip2(std::span<const uint8_t> packed, size_t size);
// LZ4 frame format.
[[nodiscard]] std::vector<uint8_t> UnpackLz4(std::span<const uint8_t> packed, size_t size);

}  // namespace lcmslam
