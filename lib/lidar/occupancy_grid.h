#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lcmslam {

// A planar map as every viewer understands it: what the planar systems publish and write at the end.
// cells[row * width + column]: < 0 free, 0 unknown, > 0 occupied; the size says how sure. Row 0 has the lowest y.
struct OccupancyGrid {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // map frame; lower left corner of cell (0, 0)
  double cell_m = 0.05;
  int width = 0;   // cells along x
  int height = 0;  // cells along y
  std::vector<int8_t> cells;

  int8_t At(int column, int row) const { return cells[static_cast<size_t>(row) * width + column]; }
};

// The grid with k x k cells merged into one, k the least that leaves at most `max_cells`. A merged cell is as occupied
// as its most occupied cell, else as free as its freest.
[[nodiscard]] OccupancyGrid CoarsenedTo(OccupancyGrid grid, int max_cells);

// Log odds in steps of 0.1, cut off at +-127; only 0 and NaN become 0.
int8_t QuantizeLogOdds(double log_odds);

// Binary PGM, highest y first as on a map: 0 occupied, 254 free, 205 unknown (ROS map_server's values).
[[nodiscard]] std::string EncodePgm(const OccupancyGrid& grid);

// The ROS map_server YAML that goes with an image of EncodePgm called `image_name`.
[[nodiscard]] std::string MapYaml(const OccupancyGrid& grid, const std::string& image_name);

// Writes STEM.pgm and STEM.yaml. "" or the reason, which names the file.
[[nodiscard]] std::string WriteMapFiles(const OccupancyGrid& grid, const std::string& stem);

}  // namespace lcmslam
