#pragma once

#include <filesystem>

#include "lidar/occupancy_grid.h"
#include "simulation/gray_image.h"
#include "simulation/planar_world.h"

namespace lcmslam {

// An occupancy grid, turned about its origin.
struct PlanarMap {
  OccupancyGrid grid;
  double origin_yaw_rad = 0.0;  // of the grid's x axis in the map frame
};

// A map in the format of ROS map_server: YAML and, beside it or where the YAML says, a PGM or PNG image. Modes trinary
// and scale; grey between the thresholds is unknown. Throws BadMap.
[[nodiscard]] PlanarMap ReadPlanarMap(const std::filesystem::path& yaml_path);

// Faces of occupied cells are walls, exactly; where known free space ends without a wall there is a barrier.
[[nodiscard]] PlanarWorld WorldOf(const PlanarMap& map);

}  // namespace lcmslam
