#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// The map's own file, exact: "LCMSDF2D", version, cell size, tiles in the order of their creation, CRC-32 of all
// before. Little-endian. The same map gives the same bytes.

// "" or "FILE: reason".
[[nodiscard]] std::string WriteMap(const SdfMap& map, const std::filesystem::path& path);

// None, with "FILE: reason" in `error`, when the file cannot be read, is cut, damaged, of another version, or no map.
[[nodiscard]] std::optional<SdfMap> ReadMap(const std::filesystem::path& path, std::string* error);

}  // namespace lcmslam::sdf2d
