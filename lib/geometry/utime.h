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

}  // namespace lcmslam
