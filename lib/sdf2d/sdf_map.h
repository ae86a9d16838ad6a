#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>

#include <Eigen/Core>

namespace lcmslam::sdf2d {

// What is known of the surfaces near the vertices of a tile; [y * kSide + x].
struct SdfSheet {
  static constexpr int kShift = 5;
  static constexpr int kSide = 1 << kShift;
  static constexpr int kVertices = kSide * kSide;

  std::array<float, kVertices> distance_m;     // signed, > 0 on the free side; NaN: no surface near
  std::array<float, kVertices> information{};  // 1/m^2, of the distance; 0: no surface near

  SdfSheet() { distance_m.fill(std::numeric_limits<float>::quiet_NaN()); }

  bool IsEmpty() const {
    return std::ranges::all_of(information, [](float value) { return value <= 0.0F; });
  }
  void Forget(int i) {
    distance_m[i] = std::numeric_limits<float>::quiet_NaN();
    information[i] = 0.0F;
  }
};

// A square of vertices. Vertex (x, y) of the tile is vertex (tile_x * kSide + x, tile_y * kSide + y) of the map.
// Surfaces that face opposite ways lie on different sheets: the two sides of a wall thinner than the band around a
// surface would otherwise erase each other.
struct SdfTile {
  static constexpr int kShift = SdfSheet::kShift;
  static constexpr int kSide = SdfSheet::kSide;
  static constexpr int kVertices = SdfSheet::kVertices;
  static constexpr int kSheets = 2;

  int32_t tile_x = 0;
  int32_t tile_y = 0;
  uint64_t revision = 0;  // of the map when the tile last changed
  std::array<SdfSheet, kSheets> sheets;
  std::array<uint8_t, kVertices> seen_through{};  // beams that passed, saturating

  SdfTile(int32_t x, int32_t y) : tile_x(x), tile_y(y) {}

  // The nearest surface to a vertex, whichever way it faces, for drawings; information 0: none.
  struct Vertex {
    float distance_m = std::numeric_limits<float>::quiet_NaN();
    float information = 0.0F;
  };
  Vertex Nearest(int i) const {
    Vertex nearest;
    for (const SdfSheet& sheet : sheets) {
      const bool nearer = !(std::abs(sheet.distance_m[i]) >= std::abs(nearest.distance_m));
      if (sheet.information[i] > 0.0F && nearer) nearest = {sheet.distance_m[i], sheet.information[i]};
    }
    return nearest;
  }

  // Of a vertex given by its index in the map.
  static constexpr int IndexOf(int32_t vertex_x, int32_t vertex_y) {
    return ((vertex_y & (kSide - 1)) << kShift) | (vertex_x & (kSide - 1));
  }
  // Of a surface with that normal (map frame). The border between the sheets lies oblique to axes and diagonals, where
  // walls are rare.
  static int SheetOf(const Eigen::Vector2d& normal) { return normal.x() * 0.3827 + normal.y() * 0.9239 >= 0.0 ? 0 : 1; }
};

// An unbounded map of signed distances to the nearest surface, sampled at vertices `cell_m` apart; vertex (i, j) lies
// at (i, j) * cell_m in the map frame. Vertices farther than a band from every surface hold NaN. A value: copies are
// independent. Reading from several threads is safe while nobody writes.
class SdfMap {
 public:
  explicit SdfMap(double cell_m) : cell_m_(cell_m) {}

  double cell_m() const { return cell_m_; }
  bool empty() const { return tiles_.empty(); }
  const std::deque<SdfTile>& tiles() const { return tiles_; }  // in the order of their creation

  // Grows with every BeginRevision; tiles changed since carry a larger revision than the one remembered then.
  uint64_t revision() const { return revision_; }
  void BeginRevision() { ++revision_; }

  // nullptr where there is none.
  const SdfTile* Find(int32_t tile_x, int32_t tile_y) const;
  SdfTile* Find(int32_t tile_x, int32_t tile_y);
  // Creates it where there is none. References stay valid.
  SdfTile& Touch(int32_t tile_x, int32_t tile_y);

 private:
  double cell_m_;
  uint64_t revision_ = 0;
  std::deque<SdfTile> tiles_;
  std::unordered_map<uint64_t, uint32_t> by_index_;  // packed tile index -> position in tiles_
};

}  // namespace lcmslam::sdf2d
