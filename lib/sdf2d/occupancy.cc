#include "sdf2d/occupancy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lcmslam::sdf2d {
namespace {

constexpr int8_t kOccupied = 100;
constexpr int8_t kFreeBySurface = -50;  // in front of a surface that was seen
constexpr int kFreePerBeam = 10;
constexpr int64_t kMaxCells = int64_t{1} << 28;

int8_t CellOf(const SdfTile& tile, int vertex, float half_cell_m) {
  const SdfTile::Vertex nearest = tile.Nearest(vertex);
  const bool near_surface = nearest.information > 0.0F;
  if (near_surface && std::abs(nearest.distance_m) <= half_cell_m) return kOccupied;
  if (near_surface && nearest.distance_m > 0.0F) return kFreeBySurface;
  return static_cast<int8_t>(-std::min<int>(kFreePerBeam * tile.seen_through[vertex], kOccupied));
}

}  // namespace

OccupancyGrid ToOccupancyGrid(const SdfMap& map) {
  OccupancyGrid grid;
  grid.cell_m = map.cell_m();
  if (map.empty()) return grid;

  constexpr int kSide = SdfTile::kSide;
  Eigen::Vector2i first = Eigen::Vector2i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector2i last = Eigen::Vector2i::Constant(std::numeric_limits<int>::min());
  for (const SdfTile& tile : map.tiles()) {
    const Eigen::Vector2i at(tile.tile_x, tile.tile_y);
    first = first.cwiseMin(at);
    last = last.cwiseMax(at);
  }
  const int64_t columns = (int64_t{last.x()} - first.x() + 1) * kSide;
  const int64_t rows = (int64_t{last.y()} - first.y() + 1) * kSide;
  if (columns > kMaxCells / rows) return grid;
  grid.width = static_cast<int>(columns);
  grid.height = static_cast<int>(rows);
  grid.origin_m = (first.cast<double>() * kSide - Eigen::Vector2d::Constant(0.5)) * grid.cell_m;
  grid.cells.assign(static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height), 0);

  const auto half_cell_m = static_cast<float>(0.5 * grid.cell_m);
  for (const SdfTile& tile : map.tiles()) {
    const size_t corner = static_cast<size_t>((tile.tile_y - first.y()) * kSide) * static_cast<size_t>(grid.width) +
                          static_cast<size_t>((tile.tile_x - first.x()) * kSide);
    for (int vertex = 0; vertex < SdfTile::kVertices; ++vertex) {
      const auto row = static_cast<size_t>(vertex / kSide), column = static_cast<size_t>(vertex % kSide);
      grid.cells[corner + row * static_cast<size_t>(grid.width) + column] = CellOf(tile, vertex, half_cell_m);
    }
  }
  return grid;
}

}  // namespace lcmslam::sdf2d
