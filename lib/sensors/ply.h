#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sensors/point_table.h"

namespace lcmslam {

// Readers of PLY files (ascii, binary_little_endian, binary_big_endian). Elements and lists that are not asked for are
// passed over. They throw BadInput, with the line where it is in the header or in ascii. Pure. Turk, "The PLY Polygon
// File Format", 1994.

// The vertices.
[[nodiscard]] PointTable ParsePly(std::span<const uint8_t> file);

struct PlyMesh {
  std::vector<Eigen::Vector3d> vertices;           // finite
  std::vector<std::array<uint32_t, 3>> triangles;  // indices into vertices
};

// Vertices and faces (list vertex_indices or vertex_index); faces of more corners become fans of triangles. A file
// without faces, with a non-finite vertex, or whose faces refer to vertices that are not there, is refused.
[[nodiscard]] PlyMesh ParsePlyMesh(std::span<const uint8_t> file);

}  // namespace lcmslam
