#pragma once

#include <chrono>
#include <cstdint>

namespace lcmslam {

// Microseconds since 1970.
inline int64_t WallClockUtime() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
}

}  // namespace lcmslam
