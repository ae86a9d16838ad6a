#include "simulation/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lcmslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// Points on a circle about the origin, from one angle to another, both included.
std::vector<Vector2d> Arc(double radius_m, double from_rad, double to_rad, double max_sagitta_m = kMaxSagitta_m) {
  const double largest_step_rad = 2.0 * std::acos(std::max(1.0 - max_sagitta_m / radius_m, 0.0));
  const int steps = std::max(3, static_cast<int>(std::ceil(std::abs(to_rad - from_rad) / largest_step_rad)));
  std::vector<Vector2d> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle_rad = from_rad + (to_rad - from_rad) * i / steps;
    points.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
  }
  return points;
}

}  // namespace

void TriangleMesh::AddQuad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const auto first = static_cast<uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {a, b, c, d});
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
}

void TriangleMesh::Append(const TriangleMesh& other) {
  const auto first = static_cast<uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) triangles.push_back({first + a, first + b, first + c});
}

TriangleMesh MakeBox(const Vector3d& size_m) {
  const double x = 0.5 * size_m.x();
  const double y = 0.5 * size_m.y();
  const double z = size_m.z();
  TriangleMesh mesh;
  mesh.vertices = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}, {-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return mesh;
}

TriangleMesh MakeCylinder(double radius_m, double height_m) {
  const std::vector<Vector2d> circle = Arc(radius_m, 0.0, kTurn_rad);
  TriangleMesh mesh;
  for (size_t i = 1; i < circle.size(); ++i) {
    const Vector2d& a = circle[i - 1];
    const Vector2d& b = circle[i];
    mesh.AddQuad({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), height_m}, {a.x(), a.y(), height_m});
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {0, 0, height_m}});
    mesh.triangles.push_back({first, first - 3, first - 4});      // base
    mesh.triangles.push_back({first + 1, first - 1, first - 2});  // top
  }
  return mesh;
}

TriangleMesh MakeSphere(double radius_m) {
  constexpr double kSagitta_m = 0.5 * kMaxSagitta_m;  // those of meridian and parallel add up
  const auto meridian = Arc(radius_m, -0.25 * kTurn_rad, 0.25 * kTurn_rad, kSagitta_m);  // (distance to the z axis, z)
  const auto equator = Arc(radius_m, 0.0, kTurn_rad, kSagitta_m);
  const auto vertex = [&](size_t i, size_t j) {
    const Vector2d around = meridian[j].x() / radius_m * equator[i];
    return Vector3d(around.x(), around.y(), meridian[j].y());
  };
  TriangleMesh mesh;
  for (size_t i = 1; i < equator.size(); ++i) {
    for (size_t j = 1; j < meridian.size(); ++j) {
      mesh.AddQuad(vertex(i - 1, j - 1), vertex(i, j - 1), vertex(i, j), vertex(i - 1, j));
    }
  }
  return mesh;
}

TriangleMesh MakeBarrelVault(double length_m, double span_m, double rise_m) {
  const double radius_m = (0.25 * span_m * span_m + rise_m * rise_m) / (2.0 * rise_m);
  const double half_angle_rad = std::asin(std::min(0.5 * span_m / radius_m, 1.0));
  const double x = 0.5 * length_m;
  TriangleMesh mesh;
  const auto arc = Arc(radius_m, 0.25 * kTurn_rad - half_angle_rad, 0.25 * kTurn_rad + half_angle_rad);
  for (size_t i = 1; i < arc.size(); ++i) {
    const Vector2d a = arc[i - 1] - Vector2d(0, radius_m - rise_m);
    const Vector2d b = arc[i] - Vector2d(0, radius_m - rise_m);
    mesh.AddQuad({-x, a.x(), a.y()}, {x, a.x(), a.y()}, {x, b.x(), b.y()}, {-x, b.x(), b.y()});
  }
  return mesh;
}

TriangleMesh MakeArchedWall(const ArchedWall& wall) {
  const double end = 0.5 * wall.length_m;
  const double jamb = 0.5 * wall.opening_width_m;
  TriangleMesh mesh;
  const auto add_panel = [&](double x0, double x1, double z0, double z1) {
    mesh.AddQuad({x0, 0, z0}, {x1, 0, z0}, {x1, 0, z1}, {x0, 0, z1});
  };
  add_panel(-end, -jamb, 0.0, wall.height_m);
  add_panel(jamb, end, 0.0, wall.height_m);
  add_panel(-jamb, jamb, 0.0, wall.sill_m);

  std::vector<Vector2d> outline = {{jamb, wall.sill_m}};  // (x, z) around the opening
  for (const Vector2d& p : Arc(jamb, 0.0, 0.5 * kTurn_rad)) outline.emplace_back(p.x(), p.y() + wall.springing_m);
  outline.emplace_back(-jamb, wall.sill_m);
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    mesh.AddQuad({a.x(), 0, a.y()}, {b.x(), 0, b.y()}, {b.x(), wall.reveal_m, b.y()}, {a.x(), wall.reveal_m, a.y()});
    const bool on_arch = i >= 1 && i + 2 < outline.size();
    if (on_arch)
      mesh.AddQuad({a.x(), 0, a.y()}, {b.x(), 0, b.y()}, {b.x(), 0, wall.height_m}, {a.x(), 0, wall.height_m});
  }
  return mesh;
}

TriangleMesh Transform(const Pose3& T_target_source, TriangleMesh mesh) {
  for (Vector3d& vertex : mesh.vertices) vertex = T_target_source * vertex;
  return mesh;
}

}  // namespace lcmslam
