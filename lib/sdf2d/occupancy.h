#pragma once

#include "lidar/occupancy_grid.h"
#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// The map as an occupancy grid with the map's cell size, one cell around each vertex: occupied where the surface is no
// farther than half a cell, free in front of a surface and where beams have passed, else unknown. Empty map, empty
// grid.
[[nodiscard]] OccupancyGrid ToOccupancyGrid(const SdfMap& map);

}  // namespace lcmslam::sdf2d
