#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// The map between its vertices: value and exact gradient of the bilinear interpolant. Remembers the last tile, so one
// reader serves one thread; it must not outlive a change of the map's tiles.
class SdfReader {
 public:
  explicit SdfReader(const SdfMap& map) : map_(map), per_cell_(1.0 / map.cell_m()) {}

  struct Sample {
    double distance_m = std::numeric_limits<double>::quiet_NaN();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  // m per m, map frame

    bool IsKnown() const { return distance_m == distance_m; }
  };

  // p_map: metres; unknown where a corner of its cell is, or where p is not finite or beyond the index range.
  Sample At(int sheet, const Eigen::Vector2d& p_map) {
    Cell cell;
    return Locate(p_map, &cell) ? Interpolate(cell, sheet) : Sample{};
  }

  // The surface near p_map (m) that a beam of that direction (map frame, any length) has most likely hit: the nearest
  // one whose normal points against the beam. Unknown where there is none, and as At.
  Sample Facing(const Eigen::Vector2d& p_map, const Eigen::Vector2d& beam) {
    Cell cell;
    Sample best;
    if (!Locate(p_map, &cell)) return best;
    for (int sheet = 0; sheet < SdfTile::kSheets; ++sheet) {
      if (cell.tile != nullptr && std::isnan(cell.tile->sheets[sheet].distance_m[SdfTile::IndexOf(cell.x, cell.y)]))
        continue;  // half of all look-ups: most surfaces have one side
      const Sample sample = Interpolate(cell, sheet);
      const bool faces = sample.gradient.dot(beam) < 0.0;  // not where unknown
      if (faces && !(std::abs(sample.distance_m) >= std::abs(best.distance_m))) best = sample;
    }
    return best;
  }

 private:
  static constexpr double kMaxIndex = 1e9;

  // Where a point lies: in the cell between vertices (x, y) and (x + 1, y + 1), at (u, v) in [0, 1).
  struct Cell {
    int32_t x, y;
    double u, v;
    const SdfTile* tile;  // holds all four vertices; nullptr where they are spread over tiles
  };

  bool Locate(const Eigen::Vector2d& p_map, Cell* cell) {
    const double x = p_map.x() * per_cell_;
    const double y = p_map.y() * per_cell_;
    if (!(std::abs(x) < kMaxIndex && std::abs(y) < kMaxIndex)) return false;
    cell->x = Floor(x);
    cell->y = Floor(y);
    cell->u = x - cell->x;
    cell->v = y - cell->y;
    constexpr int kLast = SdfTile::kSide - 1;
    cell->tile = nullptr;
    if ((cell->x & kLast) == kLast || (cell->y & kLast) == kLast) return true;
    cell->tile = TileOf(cell->x, cell->y);
    return cell->tile != nullptr;
  }

  Sample Interpolate(const Cell& cell, int sheet) {
    double d00, d10, d01, d11;  // d<x><y>
    if (cell.tile != nullptr) {
      const float* d = &cell.tile->sheets[sheet].distance_m[SdfTile::IndexOf(cell.x, cell.y)];
      d00 = d[0], d10 = d[1], d01 = d[SdfTile::kSide], d11 = d[SdfTile::kSide + 1];
    } else {
      d00 = DistanceAt(sheet, cell.x, cell.y), d10 = DistanceAt(sheet, cell.x + 1, cell.y);
      d01 = DistanceAt(sheet, cell.x, cell.y + 1), d11 = DistanceAt(sheet, cell.x + 1, cell.y + 1);
    }
    const double bottom = d00 + cell.u * (d10 - d00);
    const double top = d01 + cell.u * (d11 - d01);
    const double left = d00 + cell.v * (d01 - d00);
    const double right = d10 + cell.v * (d11 - d10);
    return {bottom + cell.v * (top - bottom), Eigen::Vector2d(right - left, top - bottom) * per_cell_};
  }

  // Without SSE 4.1, std::floor is a function call.
  static int32_t Floor(double value) {
    const auto truncated = static_cast<int32_t>(value);
    return truncated - (value < truncated ? 1 : 0);
  }

  const SdfTile* TileOf(int32_t vertex_x, int32_t vertex_y) {
    const int32_t tile_x = vertex_x >> SdfTile::kShift;
    const int32_t tile_y = vertex_y >> SdfTile::kShift;
    if (!looked_up_ || tile_x != tile_x_ || tile_y != tile_y_) {
      looked_up_ = true;
      tile_x_ = tile_x;
      tile_y_ = tile_y;
      tile_ = map_.Find(tile_x, tile_y);
    }
    return tile_;
  }

  double DistanceAt(int sheet, int32_t vertex_x, int32_t vertex_y) {
    const SdfTile* tile = TileOf(vertex_x, vertex_y);
    return tile == nullptr ? std::numeric_limits<double>::quiet_NaN()
                           : tile->sheets[sheet].distance_m[SdfTile::IndexOf(vertex_x, vertex_y)];
  }

  const SdfMap& map_;
  double per_cell_;
  bool looked_up_ = false;
  int32_t tile_x_ = 0;
  int32_t tile_y_ = 0;
  const SdfTile* tile_ = nullptr;
};

}  // namespace lcmslam::sdf2d
