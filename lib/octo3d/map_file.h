#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "octo3d/options.h"
#include "octo3d/surfel_map.h"

namespace lcmslam::octo3d {

// The map's own file, little-endian:
//   "LCMSURF1", MapOptions as 8 doubles, u32 viewpoints, u32 leaves,
//   viewpoints: 3 floats; leaves, by rising key: 3 u16, u32 viewpoint, 10 doubles (statistics), u32 CRC-32 of all
//   before.
// Planes and parents are not stored: they follow from the leaves.
void WriteMap(const SurfelMap& map, std::ostream& out);

struct ReadMapResult {
  std::optional<SurfelMap> map;
  std::string error;  // why there is no map
};
// Survives any bytes: sizes are checked against what is there before memory is taken, every number for being finite.
[[nodiscard]] ReadMapResult ReadMap(std::istream& in);

// Surfels with normals as binary little-endian PLY: x y z nx ny nz radius count.
void WritePly(std::span<const Surfel> surfels, std::ostream& out);

}  // namespace lcmslam::octo3d
