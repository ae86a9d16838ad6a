#pragma once

#include <cstdint>
#include <span>

#include "sensors/point_table.h"

namespace lcmslam {

// Reads the bytes of a PCD file (Point Cloud Library, version 0.7: ascii, binary, binary_compressed). Fields of more
// than one number are passed over. Throws BadInput, with the line where it is in the header. Pure.
// https://pointclouds.org/documentation/tutorials/pcd_file_format.html
[[nodiscard]] PointTable ParsePcd(std::span<const uint8_t> file);

}  // namespace lcmslam
