#pragma once

#include "lidar/occupancy_grid.h"
#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// The map as an occupancy grid with the map's cell size, one cell around each vertex: occupied where the surface is no
// farther than half a cell, free in front of a surface and where beams have passed, else unknown. An empty map gives an
// empty grid, and so does one whose tiles lie so far apart, after a pose was set far away, that no grid can hold them.
[[nodiscard]] OccupancyGrid ToOccupancyGrid(const SdfMap& map);

}  // namespace lcmslam::sdf2d
