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

    bool IsKnown() const { return !std::isnan(distance_m); }
  };

  // The surface near p_map (m) that a beam of that direction (map frame, any length) has most likely hit: the nearest
  // one whose normal points against the beam. Unknown where there is none, where p is not finite or beyond the index
  // range.
  Sample Facing(const Eigen::Vector2d& p_map, const Eigen::Vector2d& beam) {
    const Sample a = At(0, p_map);
    const Sample b = At(1, p_map);
    const bool a_faces = Faces(a, beam), b_faces = Faces(b, beam);
    if (a_faces && b_faces) return std::abs(a.distance_m) < std::abs(b.distance_m) ? a : b;
    if (a_faces) return a;
    if (b_faces) return b;
    return {};
  }

  // p_map: metres; unknown where a corner of its cell is, or where p is not finite or beyond the index range.
  Sample At(int sheet, const Eigen::Vector2d& p_map) {
    const double x = p_map.x() * per_cell_;
    const double y = p_map.y() * per_cell_;
    if (!(std::abs(x) < kMaxIndex && std::abs(y) < kMaxIndex)) return {};
    const double x0 = std::floor(x);
    const double y0 = std::floor(y);
    Corners corner;
    if (!ReadCorners(sheet, static_cast<int32_t>(x0), static_cast<int32_t>(y0), &corner)) return {};
    const double u = x - x0;
    const double v = y - y0;
    const double bottom = corner.d00 + u * (corner.d10 - corner.d00);
    const double top = corner.d01 + u * (corner.d11 - corner.d01);
    const double left = corner.d00 + v * (corner.d01 - corner.d00);
    const double right = corner.d10 + v * (corner.d11 - corner.d10);
    return {bottom + v * (top - bottom), Eigen::Vector2d(right - left, top - bottom) * per_cell_};
  }

 private:
  static constexpr double kMaxIndex = 1e9;

  struct Corners {
    double d00, d10, d01, d11;  // d<x><y>
  };

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

  static bool Faces(const Sample& sample, const Eigen::Vector2d& beam) { return sample.gradient.dot(beam) < 0.0; }

  double DistanceAt(int sheet, int32_t vertex_x, int32_t vertex_y) {
    const SdfTile* tile = TileOf(vertex_x, vertex_y);
    return tile == nullptr ? std::numeric_limits<double>::quiet_NaN()
                           : tile->sheets[sheet].distance_m[SdfTile::IndexOf(vertex_x, vertex_y)];
  }

  bool ReadCorners(int sheet, int32_t x, int32_t y, Corners* corner) {
    constexpr int kLast = SdfTile::kSide - 1;
    if ((x & kLast) != kLast && (y & kLast) != kLast) {
      const SdfTile* tile = TileOf(x, y);
      if (tile == nullptr) return false;
      const float* d = &tile->sheets[sheet].distance_m[SdfTile::IndexOf(x, y)];
      *corner = {d[0], d[1], d[SdfTile::kSide], d[SdfTile::kSide + 1]};
      return true;
    }
    *corner = {DistanceAt(sheet, x, y), DistanceAt(sheet, x + 1, y), DistanceAt(sheet, x, y + 1),
               DistanceAt(sheet, x + 1, y + 1)};
    return true;
  }

  const SdfMap& map_;
  double per_cell_;
  bool looked_up_ = false;
  int32_t tile_x_ = 0;
  int32_t tile_y_ = 0;
  const SdfTile* tile_ = nullptr;
};

}  // namespace lcmslam::sdf2d
