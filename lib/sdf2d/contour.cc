#include "sdf2d/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace lcmslam::sdf2d {
namespace {

// Corners of a cell in turn, relative to its lowest vertex.
constexpr std::array<std::pair<int32_t, int32_t>, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
using Corners = std::array<double, 4>;

std::optional<Corners> ReadCorners(const SdfMap& map, int sheet, int32_t x, int32_t y) {
  Corners distances_m;
  for (size_t i = 0; i < kCorners.size(); ++i) {
    const int32_t vertex_x = x + kCorners[i].first, vertex_y = y + kCorners[i].second;
    const SdfTile* tile = map.Find(vertex_x >> SdfTile::kShift, vertex_y >> SdfTile::kShift);
    if (tile == nullptr) return {};
    distances_m[i] = tile->sheets[sheet].distance_m[SdfTile::IndexOf(vertex_x, vertex_y)];
    if (std::isnan(distances_m[i])) return {};
  }
  return distances_m;
}

// Where the distance is 0 on the edge from corner i to the next, in cells; none without a change of sign.
std::optional<Eigen::Vector2d> CrossingOfEdge(const Corners& distances_m, size_t i) {
  const size_t next = (i + 1) % kCorners.size();
  const double a = distances_m[i], b = distances_m[next];
  if ((a > 0.0) == (b > 0.0)) return {};
  const Eigen::Vector2d from(kCorners[i].first, kCorners[i].second), to(kCorners[next].first, kCorners[next].second);
  return from + a / (a - b) * (to - from);
}

void AddLine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double spacing_m,
             std::vector<Eigen::Vector2d>& points) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing_m)));
  for (int k = 0; k < steps; ++k) points.emplace_back(a + (k + 0.5) / steps * (b - a));
}

void AddCell(const Corners& distances_m, const Eigen::Vector2d& lowest_m, double cell_m, double spacing_m,
             std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> crossings_m;
  for (size_t i = 0; i < kCorners.size(); ++i) {
    if (const auto crossing = CrossingOfEdge(distances_m, i)) crossings_m.emplace_back(lowest_m + cell_m * *crossing);
  }
  // At a saddle the sign in the middle says which crossings belong together.
  const double middle_m = distances_m[0] + distances_m[1] + distances_m[2] + distances_m[3];
  if (crossings_m.size() == 4 && (middle_m > 0.0) != (distances_m[0] > 0.0))
    std::ranges::rotate(crossings_m, crossings_m.begin() + 1);
  for (size_t i = 0; i + 1 < crossings_m.size(); i += 2) AddLine(crossings_m[i], crossings_m[i + 1], spacing_m, points);
}

}  // namespace

std::vector<Eigen::Vector2d> Contour(const SdfMap& map, double spacing_m) {
  std::vector<Eigen::Vector2d> points;
  for (const SdfTile& tile : map.tiles()) {
    for (int sheet = 0; sheet < SdfTile::kSheets; ++sheet) {
      for (int i = 0; i < SdfTile::kVertices; ++i) {
        const int32_t x = tile.tile_x * SdfTile::kSide + i % SdfTile::kSide;
        const int32_t y = tile.tile_y * SdfTile::kSide + i / SdfTile::kSide;
        const auto corners = ReadCorners(map, sheet, x, y);
        if (corners) AddCell(*corners, map.cell_m() * Eigen::Vector2d(x, y), map.cell_m(), spacing_m, points);
      }
    }
  }
  return points;
}

}  // namespace lcmslam::sdf2d
