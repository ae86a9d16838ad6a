#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace lcmslam {

// The surface that a map file draws, as dense points in the map's frame, m:
//   .sdf   2D-SDF-SLAM's map: its contour, a point every 5 mm
//   .yaml  an occupancy grid with its image (ROS map_server): the centres of the occupied cells
//   .ply   its points
// z = 0 in planar maps. Throws CommandError (kBadInput) for a file that is none of these or cannot be read.
[[nodiscard]] std::vector<Eigen::Vector3d> ReadMappedSurface(const std::filesystem::path& path);

}  // namespace lcmslam
