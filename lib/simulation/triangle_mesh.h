#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"

namespace lcmslam {

// A surface of triangles, seen from both sides. Metres.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;  // indices into vertices

  void AddQuad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);
  void Append(const TriangleMesh& other);
};

// Curved surfaces below are made of flat strips that stay this close to the true one.
inline constexpr double kMaxSagitta_m = 5e-5;

// Closed box, centred on the z axis, standing on z = 0.
TriangleMesh MakeBox(const Eigen::Vector3d& size_m);

// Closed cylinder about the z axis, standing on z = 0.
TriangleMesh MakeCylinder(double radius_m, double height_m);

// Sphere about the origin.
TriangleMesh MakeSphere(double radius_m);

// Barrel vault along x, centred: springs at y = +-span/2, z = 0, and crowns at y = 0, z = rise. 0 < rise <= span / 2.
TriangleMesh MakeBarrelVault(double length_m, double span_m, double rise_m);

// A wall in the plane y = 0, x in [-length/2, length/2], z in [0, height], with a round-arched opening centred at x = 0
// and the reveal (the sides of the opening, `reveal` deep towards +y). Nothing closes the opening.
struct ArchedWall {
  double length_m = 0.0;
  double height_m = 0.0;
  double opening_width_m = 0.0;  // also twice the radius of the arch
  double sill_m = 0.0;           // height of the opening's lower edge
  double springing_m = 0.0;      // height at which the arch begins
  double reveal_m = 0.0;
};
TriangleMesh MakeArchedWall(const ArchedWall& wall);

TriangleMesh Transform(const Pose3& T_target_source, TriangleMesh mesh);

}  // namespace lcmslam
