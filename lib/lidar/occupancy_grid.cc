#include "lidar/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace lcmslam {
namespace {

char PgmValue(int8_t cell) {
  if (cell > 0) return static_cast<char>(0);
  if (cell < 0) return static_cast<char>(254);
  return static_cast<char>(205);
}

std::string WriteFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  return file ? "" : fmt::format("{}: cannot write", path.string());
}

}  // namespace

OccupancyGrid CoarsenedTo(OccupancyGrid grid, int max_cells) {
  const auto parts = [](int cells, int k) { return (cells + k - 1) / k; };
  int k = 1;
  while (int64_t{parts(grid.width, k)} * parts(grid.height, k) > max_cells) ++k;
  if (k == 1) return grid;
  OccupancyGrid coarse{grid.origin_m, k * grid.cell_m, parts(grid.width, k), parts(grid.height, k), {}};
  coarse.cells.assign(static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height), 0);
  const auto merge = [](int8_t a, int8_t b) { return a > 0 || b > 0 ? std::max(a, b) : std::min(a, b); };
  for (int row = 0; row < grid.height; ++row) {
    const int8_t* cell = &grid.cells[static_cast<size_t>(row) * grid.width];
    int8_t* merged = &coarse.cells[static_cast<size_t>(row / k) * coarse.width];
    for (int begin = 0; begin < grid.width; begin += k, ++merged) {
      for (int column = begin; column < std::min(begin + k, grid.width); ++column)
        *merged = merge(*merged, cell[column]);
    }
  }
  return coarse;
}

int8_t QuantizeLogOdds(double log_odds) {
  if (std::isnan(log_odds)) return 0;
  const double steps = std::clamp(10.0 * log_odds, -127.0, 127.0);
  const int towards_zero = static_cast<int>(steps);
  return static_cast<int8_t>(towards_zero + (steps > towards_zero) - (steps < towards_zero));
}

std::string EncodePgm(const OccupancyGrid& grid) {
  std::string pgm = fmt::format("P5\n{} {}\n255\n", grid.width, grid.height);
  pgm.reserve(pgm.size() + grid.cells.size());
  for (int row = grid.height - 1; row >= 0; --row) {
    for (int column = 0; column < grid.width; ++column) pgm.push_back(PgmValue(grid.At(column, row)));
  }
  return pgm;
}

std::string MapYaml(const OccupancyGrid& grid, const std::string& image_name) {
  return fmt::format(
      "image: {}\n"
      "resolution: {}\n"
      "origin: [{}, {}, 0.0]\n"
      "negate: 0\n"
      "occupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      image_name, grid.cell_m, grid.origin_m.x(), grid.origin_m.y());
}

std::string WriteMapFiles(const OccupancyGrid& grid, const std::string& stem) {
  const std::filesystem::path image = stem + ".pgm";
  const std::string error = WriteFile(image, EncodePgm(grid));
  return error.empty() ? WriteFile(stem + ".yaml", MapYaml(grid, image.filename().string())) : error;
}

}  // namespace lcmslam
