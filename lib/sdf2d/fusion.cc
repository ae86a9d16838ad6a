#include "sdf2d/fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sdf2d/sdf_reader.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

// The tile of a vertex, created on demand; remembers the last one.
class TileWriter {
 public:
  explicit TileWriter(SdfMap* map) : map_(*map) {}

  SdfTile& TileOf(int32_t vertex_x, int32_t vertex_y) {
    const int32_t tile_x = vertex_x >> SdfTile::kShift;
    const int32_t tile_y = vertex_y >> SdfTile::kShift;
    if (tile_ == nullptr || tile_->tile_x != tile_x || tile_->tile_y != tile_y) tile_ = &map_.Touch(tile_x, tile_y);
    return *tile_;
  }

 private:
  SdfMap& map_;
  SdfTile* tile_ = nullptr;
};

bool Contradicts(float distance_m, float information, const VertexMeasurement& seen, const FusionOptions& options) {
  const float difference = std::abs(seen.distance_m - distance_m);
  if (difference < options.change_m) return false;
  const float variance = 1.0F / information + 1.0F / seen.information;
  return difference * difference > options.change_sigmas * options.change_sigmas * variance;
}

void FuseVertex(const VertexMeasurement& seen, int i, const FusionOptions& options, SdfSheet* sheet) {
  float& information = sheet->information[i];
  float& distance_m = sheet->distance_m[i];
  if (information <= 0.0F) {
    distance_m = seen.distance_m;
    information = seen.information;
    return;
  }
  if (Contradicts(distance_m, information, seen, options)) information *= static_cast<float>(options.change_keep);
  const float total = information + seen.information;
  distance_m += seen.information / total * (seen.distance_m - distance_m);
  information = std::min(total, static_cast<float>(options.max_information));
}

// A beam that has gone ever deeper behind a surface contradicts it.
bool IsPierced(float before_m, float now_m, double cell_m) {
  constexpr double kDepth_cells = 0.75;  // what rounding to a vertex can do
  return now_m < before_m && now_m < -kDepth_cells * cell_m;
}

// Takes evidence from a vertex; false once none is left.
bool Weaken(int i, const FusionOptions& options, SdfSheet* sheet) {
  constexpr float kForgotten = 1.0F;  // 1/m^2; less information is none
  sheet->information[i] *= static_cast<float>(options.carve_keep);
  if (sheet->information[i] >= kForgotten) return true;
  sheet->Forget(i);
  return false;
}

// From the lidar, vertex by vertex; `origin` and `step` in cells.
void CarveBeam(const Vector2d& origin, const Vector2d& step, int num_steps, const FusionOptions& options,
               TileWriter* writer, SdfMap* map) {
  constexpr int kBack = 3;  // vertices of a pierced surface that lose information, from the deepest back
  struct Visit {
    SdfTile* tile = nullptr;
    int i = 0;
  };
  std::array<Visit, kBack> visits;
  Vector2d at = origin + Vector2d(0.5, 0.5);
  for (int k = 0; k < num_steps; ++k, at += step) {
    const auto x = static_cast<int32_t>(std::floor(at.x()));
    const auto y = static_cast<int32_t>(std::floor(at.y()));
    const Visit before = visits[0];
    std::shift_right(visits.begin(), visits.end(), 1);
    visits[0] = {&writer->TileOf(x, y), SdfTile::IndexOf(x, y)};
    SdfTile& tile = *visits[0].tile;
    uint8_t& seen_through = tile.seen_through[visits[0].i];
    if (seen_through < 255) ++seen_through;
    tile.revision = map->revision();
    if (before.tile == nullptr) continue;
    for (int sheet = 0; sheet < SdfTile::kSheets; ++sheet) {
      const float before_m = before.tile->sheets[sheet].distance_m[before.i];
      if (!IsPierced(before_m, tile.sheets[sheet].distance_m[visits[0].i], map->cell_m())) continue;
      // The vertex behind holds least information; when it is gone, the whole column goes.
      const bool left = Weaken(visits[0].i, options, &tile.sheets[sheet]);
      for (int back = 1; back < kBack && visits[back].tile != nullptr; ++back) {
        SdfSheet& earlier = visits[back].tile->sheets[sheet];
        if (!left || !Weaken(visits[back].i, options, &earlier)) earlier.Forget(visits[back].i);
        visits[back].tile->revision = map->revision();
      }
    }
  }
}

}  // namespace

void Fuse(const ScanField& field, const FusionOptions& options, SdfMap* map) {
  TileWriter writer(map);
  for (const VertexMeasurement& seen : field.measurements()) {
    SdfTile& tile = writer.TileOf(seen.x, seen.y);
    const int i = SdfTile::IndexOf(seen.x, seen.y);
    FuseVertex(seen, i, options, &tile.sheets[seen.sheet]);
    tile.revision = map->revision();
  }
}

SdfMap Coarsen(const SdfMap& fine, double coarse_cell_m, const FusionOptions& options) {
  SdfReader reader(fine);
  std::vector<SurfaceLine> lines;  // one short piece per vertex at a surface
  for (const SdfTile& tile : fine.tiles()) {
    for (int i = 0; i < SdfTile::kVertices; ++i) {
      const Vector2d vertex = fine.cell_m() * Vector2d(tile.tile_x * SdfTile::kSide + i % SdfTile::kSide,
                                                       tile.tile_y * SdfTile::kSide + i / SdfTile::kSide);
      for (int sheet = 0; sheet < SdfTile::kSheets; ++sheet) {
        const float distance_m = tile.sheets[sheet].distance_m[i];
        const SdfReader::Sample sample = reader.At(sheet, vertex);
        if (!(std::abs(distance_m) < fine.cell_m()) || !sample.IsKnown() || sample.gradient.norm() < 0.5) continue;
        const Vector2d normal = sample.gradient.normalized();
        const Vector2d half = 0.5 * fine.cell_m() * Vector2d(-normal.y(), normal.x());
        const Vector2d foot = vertex - distance_m * normal;
        lines.push_back({.normal = normal, .begin = foot - half, .end = foot + half});
      }
    }
  }
  ScanField field;
  field.Rasterize(lines, Pose2(), coarse_cell_m, options);
  SdfMap coarse(coarse_cell_m);
  coarse.BeginRevision();
  Fuse(field, options, &coarse);
  return coarse;
}

void Carve(std::span<const Vector2d> p_body, const Vector2d& origin_body, const Pose2& T_map_body,
           const NoiseModel& noise, int first, const FusionOptions& options, SdfMap* map) {
  const double cell_m = map->cell_m();
  const Vector2d origin = (T_map_body * origin_body) / cell_m;
  TileWriter writer(map);
  for (size_t i = first; i < p_body.size(); i += options.carve_every) {
    const Vector2d end = (T_map_body * p_body[i]) / cell_m;
    const double length = (end - origin).norm();
    const double margin = std::max(
        options.band_cells, std::min(options.band_sigmas * noise.Sigma(length * cell_m), options.max_band_m) / cell_m);
    CarveBeam(origin, (end - origin) / length, static_cast<int>(length - margin - 1.0), options, &writer, map);
  }
}

}  // namespace lcmslam::sdf2d
