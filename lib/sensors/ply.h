#pragma once

#include <cstdint>
#include <span>

#include "sensors/point_table.h"

namespace lcmslam {

// Reads the vertices of a PLY file (ascii, binary_little_endian, binary_big_endian). Other elements and lists are
// passed over. Throws BadInput, with the line where it is in the header. Pure. Turk, "The PLY Polygon File Format",
// 1994.
[[nodiscard]] PointTable ParsePly(std::span<const uint8_t> file);

}  // namespace lcmslam
