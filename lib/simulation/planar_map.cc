#include "simulation/planar_map.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "geometry/pose2.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

// The fields of a map_server YAML.
struct MapDescription {
  std::filesystem::path image;
  double resolution_m = 0.0;
  Pose2 T_map_grid;
  bool negate = false;
  double occupied_threshold = 0.65;  // of the probability: above is occupied
  double free_threshold = 0.196;     // below is free
};

template <class T>
T Field(const YAML::Node& yaml, const char* name) {
  if (!yaml[name]) throw BadMap(fmt::format("{}: missing", name));
  try {
    return yaml[name].as<T>();
  } catch (const YAML::Exception&) {
    throw BadMap(fmt::format("{}: malformed", name));
  }
}

void Require(bool condition, const char* reason) {
  if (!condition) throw BadMap(reason);
}

MapDescription Describe(const YAML::Node& yaml) {
  Require(yaml.IsMap(), "not a map of map_server");
  MapDescription description{
      .image = Field<std::string>(yaml, "image"), .resolution_m = Field<double>(yaml, "resolution"), .T_map_grid = {}};
  Require(description.resolution_m > 0.0 && std::isfinite(description.resolution_m), "resolution: must be positive");
  const auto origin = Field<std::vector<double>>(yaml, "origin");
  Require(origin.size() == 3, "origin: must be [x, y, yaw]");
  description.T_map_grid = Pose2(origin[0], origin[1], origin[2]);
  Require(description.T_map_grid.IsFinite(), "origin: must be finite");
  if (yaml["negate"]) description.negate = Field<int>(yaml, "negate") != 0;
  if (yaml["occupied_thresh"]) description.occupied_threshold = Field<double>(yaml, "occupied_thresh");
  if (yaml["free_thresh"]) description.free_threshold = Field<double>(yaml, "free_thresh");
  Require(description.free_threshold <= description.occupied_threshold, "free_thresh: must not exceed occupied_thresh");
  const std::string mode = yaml["mode"] ? Field<std::string>(yaml, "mode") : "trinary";
  Require(mode == "trinary" || mode == "scale", "mode: must be trinary or scale");
  return description;
}

int8_t CellOf(uint8_t pixel, const MapDescription& description) {
  const double occupied = (description.negate ? pixel : 255 - pixel) / 255.0;
  if (occupied > description.occupied_threshold) return 1;
  return occupied < description.free_threshold ? -1 : 0;
}

PlanarMap Assemble(const MapDescription& description, const GrayImage& image) {
  PlanarMap map{.grid = {.origin_m = description.T_map_grid.translation(),
                         .cell_m = description.resolution_m,
                         .width = image.width,
                         .height = image.height,
                         .cells = {}},
                .origin_yaw_rad = description.T_map_grid.yaw()};
  for (int row = image.height - 1; row >= 0; --row) {  // images begin at the top, grids at the lowest y
    for (int column = 0; column < image.width; ++column) {
      const size_t pixel = static_cast<size_t>(row) * static_cast<size_t>(image.width) + static_cast<size_t>(column);
      map.grid.cells.push_back(CellOf(image.pixels[pixel], description));
    }
  }
  return map;
}

enum class Face { kNone, kWall, kBarrier };

Face FaceBetween(int8_t cell, int8_t neighbour) {
  if ((cell > 0) != (neighbour > 0)) return Face::kWall;
  return (cell < 0) != (neighbour < 0) ? Face::kBarrier : Face::kNone;
}

// Collects the faces along the grid's lines, in units of cells; adjoining faces of one kind make one segment.
class FaceCollector {
 public:
  explicit FaceCollector(const OccupancyGrid& grid) : grid_(grid) {}

  // Lines of constant x (axis 0) or constant y (axis 1).
  void CollectAcross(int axis) {
    const int lines = axis == 0 ? grid_.width : grid_.height;
    const int length = axis == 0 ? grid_.height : grid_.width;
    for (int line = 0; line <= lines; ++line) {
      Face run = Face::kNone;
      int run_start = 0;
      for (int along = 0; along <= length; ++along) {
        const Face face = along == length ? Face::kNone : FaceAt(axis, line, along);
        if (face == run) continue;
        Add(run, axis, line, run_start, along);
        run = face;
        run_start = along;
      }
    }
  }

  std::vector<Segment> walls;
  std::vector<Segment> barriers;

 private:
  int8_t Cell(int column, int row) const {
    const bool inside = column >= 0 && row >= 0 && column < grid_.width && row < grid_.height;
    return inside ? grid_.At(column, row) : int8_t{0};
  }
  Face FaceAt(int axis, int line, int along) const {
    return axis == 0 ? FaceBetween(Cell(line - 1, along), Cell(line, along))
                     : FaceBetween(Cell(along, line - 1), Cell(along, line));
  }
  void Add(Face face, int axis, int line, int from, int to) {
    if (face == Face::kNone) return;
    Segment segment{Vector2d(line, from), Vector2d(line, to)};
    if (axis == 1) segment = {Vector2d(from, line), Vector2d(to, line)};
    (face == Face::kWall ? walls : barriers).push_back(segment);
  }

  const OccupancyGrid& grid_;
};

}  // namespace

PlanarMap ReadPlanarMap(const std::filesystem::path& yaml_path) {
  MapDescription description;
  try {
    description = Describe(YAML::LoadFile(yaml_path.string()));
  } catch (const YAML::BadFile&) {
    throw BadMap(fmt::format("{}: cannot be read", yaml_path.string()));
  } catch (const std::exception& error) {
    throw BadMap(fmt::format("{}: {}", yaml_path.string(), error.what()));
  }
  return Assemble(description, ReadGrayImage(yaml_path.parent_path() / description.image));
}

PlanarWorld WorldOf(const PlanarMap& map) {
  FaceCollector faces(map.grid);
  faces.CollectAcross(0);
  faces.CollectAcross(1);
  const Pose2 T_map_grid(map.grid.origin_m, map.origin_yaw_rad);
  for (std::vector<Segment>* segments : {&faces.walls, &faces.barriers}) {
    for (Segment& segment : *segments) {
      segment = {T_map_grid * (map.grid.cell_m * segment.a), T_map_grid * (map.grid.cell_m * segment.b)};
    }
  }
  return PlanarWorld(std::move(faces.walls), std::move(faces.barriers));
}

}  // namespace lcmslam
