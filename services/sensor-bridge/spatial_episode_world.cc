#include "sensor-bridge/spatial_episode_world.h"

#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "bus/errors.h"
#include "sensors/bad_input.h"
#include "sensors/input_file.h"
#include "sensors/ply.h"
#include "simulation/spatial_worlds.h"
#include "simulation/triangle_mesh.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr const char* kDefaultWorld = "hall10";
constexpr double kMaxSize_m = 10'000.0;
constexpr double kFarthest_m = 100'000.0;

// One part of the world as the episode file has it.
class Part {
 public:
  Part(google::protobuf::Message& config, std::string path) : path_(std::move(path)), bind_(config, path_ + ".") {}

  // A length or a factor that must be there and positive.
  double Positive(const char* field) {
    double value = 0.0;
    bind_(field, value);
    Require(value > 0.0 && value <= kMaxSize_m, field, "must be in (0, 10000]");
    return value;
  }
  double NotNegative(const char* field) {
    double value = 0.0;
    bind_(field, value);
    Require(value >= 0.0 && value <= kMaxSize_m, field, "must be in 0..10000");
    return value;
  }
  void Require(bool holds, const char* field, const char* rule) const {
    if (!holds) RequireValid(fmt::format("{}.{}: {}", path_, field, rule));
  }
  Solid Placed(TriangleMesh mesh) {
    double reflectivity = 0.5;
    bind_("reflectivity", reflectivity);
    Require(reflectivity >= 0.0 && reflectivity <= 1.0, "reflectivity", "must be in 0..1");
    Solid solid{Transform(BindSpatialPose(bind_.Sub("pose")), std::move(mesh)), static_cast<float>(reflectivity)};
    for (const Vector3d& vertex : solid.mesh.vertices) {
      Require((vertex.array().abs() <= kFarthest_m).all(), "pose", "must leave it within 100 km");
    }
    return solid;
  }
  const std::string& path() const { return path_; }
  ConfigBinder& bind() { return bind_; }

 private:
  std::string path_;
  ConfigBinder bind_;
};

TriangleMesh BoxOf(Part& part) {
  return MakeBox({part.Positive("length_m"), part.Positive("width_m"), part.Positive("height_m")});
}

TriangleMesh CylinderOf(Part& part) { return MakeCylinder(part.Positive("radius_m"), part.Positive("height_m")); }

TriangleMesh ArchedWallOf(Part& part) {
  const ArchedWall wall{.length_m = part.Positive("length_m"),
                        .height_m = part.Positive("height_m"),
                        .opening_width_m = part.Positive("opening_width_m"),
                        .sill_m = part.NotNegative("sill_m"),
                        .springing_m = part.NotNegative("springing_m"),
                        .reveal_m = part.NotNegative("reveal_m")};
  part.Require(wall.length_m > wall.opening_width_m, "length_m", "must exceed opening_width_m");
  part.Require(wall.springing_m >= wall.sill_m, "springing_m", "must not be below sill_m");
  part.Require(wall.height_m > wall.springing_m + 0.5 * wall.opening_width_m, "height_m",
               "must exceed springing_m + opening_width_m / 2");
  return MakeArchedWall(wall);
}

TriangleMesh VaultOf(Part& part) {
  const double length_m = part.Positive("length_m"), span_m = part.Positive("span_m"), rise_m = part.Positive("rise_m");
  part.Require(rise_m <= 0.5 * span_m, "rise_m", "must not exceed span_m / 2");
  return MakeBarrelVault(length_m, span_m, rise_m);
}

PlyMesh ReadPly(const std::filesystem::path& path, const std::string& field) {
  try {
    const std::string bytes = ReadInput(path);
    return ParsePlyMesh({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  } catch (const BadInput& error) {
    const std::string reason = error.what();
    const std::string name = path.string();
    throw CommandError(ExitCode::kBadInput,
                       fmt::format("{}: {}", field, reason.find(name) == 0 ? reason : name + ": " + reason));
  }
}

TriangleMesh MeshOf(Part& part, const std::filesystem::path& folder) {
  std::string file;
  double scale = 1.0;
  part.bind()("file", file)("scale", scale);
  part.Require(!file.empty(), "file", "is not set");
  part.Require(scale > 0.0 && scale <= 1e6, "scale", "must be in (0, 1e6]");
  PlyMesh ply = ReadPly(folder / file, part.path() + ".file");
  for (Vector3d& vertex : ply.vertices) vertex *= scale;
  return {std::move(ply.vertices), std::move(ply.triangles)};
}

// Adds a solid for each part of one kind.
template <class Parts, class MakeMesh>
void Add(Parts& configs, const std::string& kind, const MakeMesh& make_mesh, std::vector<Solid>& solids) {
  for (int i = 0; i < configs.size(); ++i) {
    Part part(*configs.Mutable(i), fmt::format("spatial.world.{}[{}]", kind, i));
    solids.push_back(part.Placed(make_mesh(part)));
  }
}

// What the episode's own parts are added to.
SpatialParts NamedParts(config::Episode::SpatialWorld& config) {
  const bool has_parts = config.box_size() + config.cylinder_size() + config.arched_wall_size() + config.vault_size() +
                             config.mesh_size() >
                         0;
  if (!config.has_name() && !has_parts) config.set_name(kDefaultWorld);
  if (!config.has_name()) {
    if (!config.has_inside()) RequireValid("spatial.world.inside: is not set");
    return {};
  }
  std::optional<SpatialParts> parts = NamedSpatialParts(config.name());
  if (!parts) RequireValid(fmt::format("spatial.world.name: no world is called '{}'", config.name()));
  return *std::move(parts);
}

}  // namespace

Pose3 BindSpatialPose(ConfigBinder bind) {
  Pose3 pose;
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  bind("x_m", pose.translation.x())("y_m", pose.translation.y())("z_m", pose.translation.z());
  bind("yaw_rad", yaw_rad)("pitch_rad", pitch_rad)("roll_rad", roll_rad);
  pose.rotation = Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vector3d::UnitY()) *
                  Eigen::AngleAxisd(roll_rad, Vector3d::UnitX());
  return pose;
}

SpatialWorld MakeSpatialWorld(config::Episode::SpatialWorld& config, const std::filesystem::path& folder) {
  auto [solids, p_inside] = NamedParts(config);
  Add(*config.mutable_box(), "box", BoxOf, solids);
  Add(*config.mutable_cylinder(), "cylinder", CylinderOf, solids);
  Add(*config.mutable_arched_wall(), "arched_wall", ArchedWallOf, solids);
  Add(*config.mutable_vault(), "vault", VaultOf, solids);
  Add(
      *config.mutable_mesh(), "mesh", [&](Part& part) { return MeshOf(part, folder); }, solids);
  ConfigBinder inside(*config.mutable_inside(), "spatial.world.inside.");
  inside("x_m", p_inside.x())("y_m", p_inside.y())("z_m", p_inside.z());
  return {solids, p_inside};
}

}  // namespace lcmslam
