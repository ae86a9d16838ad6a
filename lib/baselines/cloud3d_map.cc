#include "baselines/cloud3d_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <ostream>
#include <unordered_map>
#include <utility>

namespace lcmslam::cloud3d {
namespace {

constexpr float kMaxCell = 1e9F;  // from the origin, within int

// Finds out whether a new point is too near to another new one: a grid of cells of the spacing.
class SpacedPoints {
 public:
  explicit SpacedPoints(float spacing_m) : spacing_m_(spacing_m) {}

  // False, and nothing added, when another point is nearer than the spacing.
  bool Add(const Eigen::Vector3f& p) {
    const Cell cell{CellOf(p.x()), CellOf(p.y()), CellOf(p.z())};
    for (int i = 0; i < 27; ++i) {
      const auto near = cells_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (near == cells_.end()) continue;
      for (const Eigen::Vector3f& q : near->second) {
        if ((p - q).squaredNorm() < spacing_m_ * spacing_m_) return false;
      }
    }
    cells_[cell].push_back(p);
    return true;
  }

 private:
  using Cell = std::array<int, 3>;
  struct Hash {
    size_t operator()(const Cell& c) const {  // Teschner et al., "Optimized Spatial Hashing", VMV 2003
      return static_cast<size_t>(c[0]) * 73856093U ^ static_cast<size_t>(c[1]) * 19349663U ^
             static_cast<size_t>(c[2]) * 83492791U;
    }
  };
  int CellOf(float coordinate_m) const {
    return static_cast<int>(std::clamp(std::floor(coordinate_m / spacing_m_), -kMaxCell, kMaxCell));
  }

  float spacing_m_;
  std::unordered_map<Cell, std::vector<Eigen::Vector3f>, Hash> cells_;
};

}  // namespace

std::string MapOptions::Validate() const {
  if (!(spacing_m >= 0.001 && spacing_m <= 100.0)) return "spacing_m: must be in [0.001, 100]";
  return "";
}

int Map::Grow(const Cloud& cloud_map) {
  const float spacing_m = static_cast<float>(options_.spacing_m);
  SpacedPoints fresh(spacing_m);
  std::vector<Eigen::Vector3f> points = tree_.points();
  std::array<Neighbour, 1> nearest;
  for (size_t i = 0; i < cloud_map.size(); ++i) {
    const Eigen::Vector3f& p = cloud_map.points[i];
    if (!p.allFinite() || tree_.Nearest(p, spacing_m, 0.0F, nearest) > 0 || !fresh.Add(p)) continue;
    points.push_back(p);
    normals_.push_back(cloud_map.normals[i]);
  }
  const int grown = static_cast<int>(points.size() - tree_.points().size());
  if (grown == 0) return 0;
  tree_ = KdTree(std::move(points));
  return grown;
}

void WritePly(const Map& map, std::ostream& out) {
  static_assert(std::endian::native == std::endian::little && sizeof(Eigen::Vector3f) == 12);
  out << "ply\nformat binary_little_endian 1.0\ncomment metres, map frame; normals towards the sensor\nelement vertex "
      << map.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "property float " << name << '\n';
  out << "end_header\n";
  for (size_t i = 0; i < map.size(); ++i) {
    out.write(reinterpret_cast<const char*>(map.points()[i].data()), sizeof(Eigen::Vector3f));
    out.write(reinterpret_cast<const char*>(map.normals()[i].data()), sizeof(Eigen::Vector3f));
  }
}

}  // namespace lcmslam::cloud3d
