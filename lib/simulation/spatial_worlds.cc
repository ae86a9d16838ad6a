#include "simulation/spatial_worlds.h"

#include <vector>

#include <Eigen/Geometry>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr float kPlaster = 0.7F;
constexpr float kFloor = 0.3F;
constexpr float kWood = 0.5F;
constexpr float kMetal = 0.8F;
constexpr float kCloth = 0.2F;

// Moved to (x, y, z) and turned about the vertical.
Pose3 At(double x_m, double y_m, double z_m = 0.0, double yaw_deg = 0.0) {
  return {{x_m, y_m, z_m}, Eigen::Quaterniond(AngleAxisd(DegToRad(yaw_deg), Vector3d::UnitZ()))};
}

// Collects the solids of a world; parts stand on z of their pose.
class Builder {
 public:
  Builder& Add(TriangleMesh mesh, const Pose3& T_world_part, float reflectivity) {
    solids_.push_back({Transform(T_world_part, std::move(mesh)), reflectivity});
    return *this;
  }
  Builder& Box(const Vector3d& size_m, const Pose3& T_world_box, float reflectivity) {
    return Add(MakeBox(size_m), T_world_box, reflectivity);
  }
  Builder& Cylinder(double radius_m, double height_m, const Pose3& T_world_cylinder, float reflectivity) {
    return Add(MakeCylinder(radius_m, height_m), T_world_cylinder, reflectivity);
  }

  Builder& Table(const Vector3d& size_m, const Pose3& T_world_table);
  Builder& Chair(const Pose3& T_world_chair);
  Builder& Bookcase(const Vector3d& size_m, int num_shelves, const Pose3& T_world_bookcase);
  Builder& Radiator(double length_m, const Pose3& T_world_radiator);
  Builder& DoorFrame(const Pose3& T_world_door);

  SpatialParts Build(const Vector3d& p_inside) { return {std::move(solids_), p_inside}; }

 private:
  std::vector<Solid> solids_;
};

Builder& Builder::Table(const Vector3d& size_m, const Pose3& T_world_table) {
  constexpr double kTop_m = 0.03;
  constexpr double kLegRadius_m = 0.025;
  const double top_z = size_m.z() - kTop_m;
  Box({size_m.x(), size_m.y(), kTop_m}, T_world_table * At(0, 0, top_z), kWood);
  for (const double x : {-0.5 * size_m.x() + 0.06, 0.5 * size_m.x() - 0.06}) {
    for (const double y : {-0.5 * size_m.y() + 0.06, 0.5 * size_m.y() - 0.06}) {
      Cylinder(kLegRadius_m, top_z, T_world_table * At(x, y), kMetal);
    }
  }
  return *this;
}

// Its back at negative x.
Builder& Builder::Chair(const Pose3& T_world_chair) {
  Table({0.42, 0.42, 0.45}, T_world_chair);
  return Box({0.03, 0.42, 0.40}, T_world_chair * At(-0.195, 0, 0.5), kWood);
}

// Open towards +x, its back at x = 0.
Builder& Builder::Bookcase(const Vector3d& size_m, int num_shelves, const Pose3& T_world_bookcase) {
  constexpr double kBoard_m = 0.02;
  const double middle = 0.5 * size_m.x();
  Box({kBoard_m, size_m.y(), size_m.z()}, T_world_bookcase * At(0.5 * kBoard_m, 0), kWood);
  for (const double side : {-1.0, 1.0}) {
    Box({size_m.x(), kBoard_m, size_m.z()}, T_world_bookcase * At(middle, 0.5 * side * (size_m.y() - kBoard_m)), kWood);
  }
  for (int i = 0; i <= num_shelves; ++i) {
    const double z = i * (size_m.z() - kBoard_m) / num_shelves;
    Box({size_m.x(), size_m.y(), kBoard_m}, T_world_bookcase * At(middle, 0, z), kWood);
  }
  return *this;
}

// Ribs along y, depth towards +x.
Builder& Builder::Radiator(double length_m, const Pose3& T_world_radiator) {
  constexpr double kPitch_m = 0.06;
  const int num_ribs = static_cast<int>(length_m / kPitch_m);
  for (int i = 0; i < num_ribs; ++i) {
    Box({0.10, 0.04, 0.60}, T_world_radiator * At(0.08, (i - 0.5 * (num_ribs - 1)) * kPitch_m, 0.12), kMetal);
  }
  return *this;
}

// On a wall at x = 0, proud towards +x.
Builder& Builder::DoorFrame(const Pose3& T_world_door) {
  for (const double y : {-0.5, 0.5}) Box({0.06, 0.08, 2.1}, T_world_door * At(0, y), kWood);
  return Box({0.06, 1.08, 0.08}, T_world_door * At(0, 0, 2.1), kWood);
}

// Seen from inside; stands on z = 0 between x = 0..size.x and y = 0..size.y.
void AddShell(Builder& builder, const Vector3d& size_m) {
  builder.Box(size_m, At(0.5 * size_m.x(), 0.5 * size_m.y()), kPlaster);
}

void AddHallShell(Builder& builder) {
  constexpr double kSpringing_m = 2.0;
  constexpr double kWall_m = 0.3;
  builder.Box({10.0, 8.0, kWall_m}, At(5.0, 4.0, -kWall_m), kFloor);
  builder.Box({10.0, kWall_m, kSpringing_m}, At(5.0, -0.5 * kWall_m), kPlaster);
  builder.Box({10.0, kWall_m, kSpringing_m}, At(5.0, 8.0 + 0.5 * kWall_m), kPlaster);
  builder.Box({kWall_m, 8.0, 3.0}, At(-0.5 * kWall_m, 4.0), kPlaster);
  builder.Add(MakeArchedWall({.length_m = 8.0,
                              .height_m = 3.0,
                              .opening_width_m = 1.6,
                              .sill_m = 0.9,
                              .springing_m = 1.8,
                              .reveal_m = kWall_m}),
              At(10.0, 4.0, 0.0, -90.0), kPlaster);
  builder.Add(MakeBarrelVault(10.0, 8.0, 1.0), At(5.0, 4.0, kSpringing_m), kPlaster);
}

void AddHallFurniture(Builder& builder) {
  builder.Radiator(1.5, At(10.0, 4.0, 0.0, 180.0)).Radiator(1.2, At(3.0, 0.0, 0.0, 90.0));
  builder.Radiator(1.2, At(7.0, 8.0, 0.0, -90.0));
  builder.Bookcase({0.35, 1.6, 1.9}, 5, At(0.0, 2.2)).Bookcase({0.35, 1.0, 1.9}, 5, At(5.2, 8.0, 0.0, -90.0));
  builder.Box({0.6, 1.4, 1.85}, At(0.3, 6.4), kWood);    // cupboard
  builder.Box({1.2, 0.45, 0.8}, At(6.2, 0.225), kWood);  // sideboard
  builder.Table({1.8, 0.9, 0.74}, At(2.6, 6.6, 0.0, 8.0))
      .Chair(At(2.4, 5.9, 0.0, 95.0))
      .Chair(At(3.2, 7.4, 0.0, -70.0));
  builder.Table({1.4, 0.7, 0.72}, At(8.2, 6.9, 0.0, -25.0)).Chair(At(7.8, 6.2, 0.0, 70.0));
  builder.Cylinder(0.45, 0.03, At(8.4, 1.6, 0.70), kWood).Cylinder(0.04, 0.70, At(8.4, 1.6), kMetal);  // round table
  builder.Chair(At(7.8, 1.2, 0.0, 30.0)).Chair(At(8.9, 2.2, 0.0, -130.0));
  builder.Box({0.85, 1.9, 0.42}, At(0.5, 4.3), kCloth).Box({0.2, 1.9, 0.8}, At(0.12, 4.3), kCloth);  // sofa
  builder.Box({0.6, 0.5, 0.5}, At(9.4, 0.6, 0.0, 20.0), kCloth).Box({0.4, 0.4, 0.35}, At(9.4, 0.6, 0.5, 50.0), kCloth);
  builder.Cylinder(0.15, 3.0, At(3.6, 2.6), kPlaster).Cylinder(0.15, 3.0, At(6.4, 5.4), kPlaster);  // pillars
  builder.Add(MakeSphere(0.33), At(1.0, 0.8, 0.33), kCloth);                                        // gymnastic ball
}

SpatialParts Hall10() {
  Builder builder;
  AddHallShell(builder);
  AddHallFurniture(builder);
  return builder.Build({5.0, 4.0, 1.3});
}

SpatialParts BareRoom() {
  Builder builder;
  AddShell(builder, {6.0, 5.0, 2.7});
  return builder.Build({3.0, 2.5, 1.3});
}

SpatialParts Corridor40() {
  Builder builder;
  AddShell(builder, {40.0, 2.0, 2.6});
  for (const double x : {3.0, 8.5, 14.0, 19.5, 25.0, 30.5, 36.0}) builder.DoorFrame(At(x, 0.0, 0.0, 90.0));
  for (const double x : {5.5, 17.0, 28.5}) builder.DoorFrame(At(x, 2.0, 0.0, -90.0));
  return builder.Build({20.0, 1.0, 1.3});
}

SpatialWorld Built(const SpatialParts& parts) { return {parts.solids, parts.p_inside}; }

}  // namespace

std::optional<SpatialParts> NamedSpatialParts(std::string_view name) {
  if (name == "hall10") return Hall10();
  if (name == "bare_room") return BareRoom();
  if (name == "corridor40") return Corridor40();
  return std::nullopt;
}

std::optional<SpatialWorld> NamedSpatialWorld(std::string_view name) {
  const std::optional<SpatialParts> parts = NamedSpatialParts(name);
  if (!parts) return std::nullopt;
  return Built(*parts);
}

SpatialWorld Hall10World() { return Built(Hall10()); }
SpatialWorld BareRoomWorld() { return Built(BareRoom()); }
SpatialWorld Corridor40World() { return Built(Corridor40()); }

}  // namespace lcmslam
