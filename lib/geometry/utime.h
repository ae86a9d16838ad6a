#pragma once

#include <cstdint>
#include <limits>

namespace lcmslam {

// later - earlier in us, at the ends of int64 where it would overflow: stamps come from outside.
inline int64_t UtimeDifference(int64_t later, int64_t earlier) {
  int64_t difference = 0;
  if (!__builtin_sub_overflow(later, earlier, &difference)) return difference;
  return later > earlier ? std::numeric_limits<int64_t>::max() : std::numeric_limits<int64_t>::min();
}

// Whether differences and small shifts of such stamps stay within int64.
constexpr bool IsReasonableUtime(int64_t utime) {
  constexpr int64_t kLimit = int64_t{1} << 61;
  return -kLimit < utime && utime < kLimit;
}

}  // namespace lcmslam
