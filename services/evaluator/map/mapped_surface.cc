#include "evaluator/map/mapped_surface.h"

#include <iterator>

#include <fmt/format.h>

#include "bus/errors.h"
#include "sdf2d/contour.h"
#include "sdf2d/map_file.h"
#include "sensors/bad_input.h"
#include "sensors/input_file.h"
#include "sensors/ply.h"
#include "simulation/planar_map.h"

namespace lcmslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points SurfaceOfSdf(const std::filesystem::path& path) {
  constexpr double kSpacing_m = 0.005;
  std::string error;
  const auto map = sdf2d::ReadMap(path, &error);
  if (!map) throw CommandError(ExitCode::kBadInput, error);
  Points points;
  for (const Eigen::Vector2d& p : sdf2d::Contour(*map, kSpacing_m)) points.emplace_back(p.x(), p.y(), 0.0);
  return points;
}

Points SurfaceOfGrid(const std::filesystem::path& path) {
  const PlanarMap map = ReadPlanarMap(path);
  const OccupancyGrid& grid = map.grid;
  const Eigen::Rotation2Dd turn(map.origin_yaw_rad);
  Points points;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      if (grid.At(column, row) <= 0) continue;
      const Eigen::Vector2d p = grid.origin_m + turn * (grid.cell_m * Eigen::Vector2d(column + 0.5, row + 0.5));
      points.emplace_back(p.x(), p.y(), 0.0);
    }
  }
  return points;
}

Points PointsOfPly(const std::filesystem::path& path) {
  const auto file = OpenInput(path);
  const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(*file), {}};
  try {
    Points points;
    for (const SweepPoint& point : ToSweepPoints(ParsePly(bytes))) {
      if (point.IsFinite()) points.emplace_back(point.x, point.y, point.z);
    }
    return points;
  } catch (const BadInput& bad) {  // which knows only the bytes
    throw BadInput(fmt::format("{}: {}", path.string(), bad.what()));
  }
}

Points Read(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".sdf") return SurfaceOfSdf(path);
  if (extension == ".yaml") return SurfaceOfGrid(path);
  if (extension == ".ply") return PointsOfPly(path);
  throw CommandError(ExitCode::kBadInput, fmt::format("{}: not a .sdf, .yaml or .ply map", path.string()));
}

}  // namespace

std::vector<Eigen::Vector3d> ReadMappedSurface(const std::filesystem::path& path) {
  try {
    Points points = Read(path);
    if (points.empty()) throw CommandError(ExitCode::kBadInput, fmt::format("{}: no surface in it", path.string()));
    return points;
  } catch (const BadInput& bad) {
    throw CommandError(ExitCode::kBadInput, bad.what());
  } catch (const BadMap& bad) {
    throw CommandError(ExitCode::kBadInput, bad.what());
  }
}

}  // namespace lcmslam
