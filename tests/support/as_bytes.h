#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lcmslam {

// The view lives as long as `text`.
inline std::span<const uint8_t> AsBytes(const std::string& text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

}  // namespace lcmslam
