#include "simulation/spatial_world.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr char kDeviceConfig[] = "threads=1,isa=sse4.2";

// Rays that Embree follows together.
constexpr Eigen::Index kStream = 64;

// What Embree's streams want beside rays and hits.
struct Stream {
  using Floats = Eigen::Array<float, kStream, 1>;
  using Words = Eigen::Array<unsigned, kStream, 1>;

  Floats tnear = Floats::Zero();
  Floats time = Floats::Zero();
  Words mask = Words::Constant(~0U);
  Words id = Words::Zero();
  Words flags = Words::Zero();
  Eigen::Array<float, kStream, 3> normals;
  Eigen::Array<float, kStream, 2> coordinates;
  Words geometries;
  Words instances;

  void Cast(RTCScene scene, const SpatialRays& rays, SpatialHits& hits, Eigen::Index first, Eigen::Index count,
            unsigned nothing);
};

void Stream::Cast(RTCScene scene, const SpatialRays& rays, SpatialHits& hits, Eigen::Index first, Eigen::Index count,
                  unsigned nothing) {
  // Embree takes rays and results alike as pointers to what it may write, but leaves origins and directions alone.
  const auto column = [first](const Eigen::ArrayX3f& a, int i) { return const_cast<float*>(a.col(i).data()) + first; };
  RTCRayHitNp stream;
  stream.ray = {.org_x = column(rays.origins, 0),
                .org_y = column(rays.origins, 1),
                .org_z = column(rays.origins, 2),
                .tnear = tnear.data(),
                .dir_x = column(rays.directions, 0),
                .dir_y = column(rays.directions, 1),
                .dir_z = column(rays.directions, 2),
                .time = time.data(),
                .tfar = hits.ranges_m.data() + first,
                .mask = mask.data(),
                .id = id.data(),
                .flags = flags.data()};
  stream.hit = {.Ng_x = normals.col(0).data(),
                .Ng_y = normals.col(1).data(),
                .Ng_z = normals.col(2).data(),
                .u = coordinates.col(0).data(),
                .v = coordinates.col(1).data(),
                .primID = hits.facets.data() + first,
                .geomID = geometries.data(),
                .instID = {instances.data()}};
  hits.ranges_m.segment(first, count) = std::numeric_limits<float>::infinity();
  hits.facets.segment(first, count) = nothing;
  geometries = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersectNp(scene, &context, &stream, static_cast<unsigned>(count));
}

// All triangles of the world as one mesh, in the order of the solids.
TriangleMesh Merged(const std::vector<Solid>& solids) {
  TriangleMesh all;
  for (const Solid& solid : solids) all.Append(solid.mesh);
  return all;
}

std::vector<Facet> FacetsOf(const std::vector<Solid>& solids) {
  std::vector<Facet> facets;
  for (const auto& [mesh, reflectivity] : solids) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d& corner = mesh.vertices[a];
      const Vector3d normal = (mesh.vertices[b] - corner).cross(mesh.vertices[c] - corner).stableNormalized();
      facets.push_back({normal.cast<float>(), reflectivity});
    }
  }
  facets.push_back({Eigen::Vector3f::Zero(), 0.0F});
  return facets;
}

// The closest point of triangle abc to p (Ericson, "Real-Time Collision Detection", 2005, section 5.1.5).
Vector3d ClosestPoint(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

struct NearestSurface {
  const TriangleMesh& mesh;
  Vector3d p;
  double distance_m;
};

bool VisitTriangle(RTCPointQueryFunctionArguments* visit) {
  auto& nearest = *static_cast<NearestSurface*>(visit->userPtr);
  const auto& [a, b, c] = nearest.mesh.triangles[visit->primID];
  const std::vector<Vector3d>& vertices = nearest.mesh.vertices;
  const double distance_m = (ClosestPoint(nearest.p, vertices[a], vertices[b], vertices[c]) - nearest.p).norm();
  if (distance_m >= nearest.distance_m) return false;
  nearest.distance_m = distance_m;
  visit->query->radius = static_cast<float>(distance_m);
  return true;
}

}  // namespace

struct SpatialWorld::Scene {
  TriangleMesh mesh;          // Embree's only geometry
  std::vector<Facet> facets;  // of mesh.triangles, and one for nothing
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device{rtcNewDevice(kDeviceConfig), rtcReleaseDevice};
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene{nullptr, rtcReleaseScene};

  explicit Scene(const std::vector<Solid>& solids);
  void Attach();
};

SpatialWorld::Scene::Scene(const std::vector<Solid>& solids) : mesh(Merged(solids)), facets(FacetsOf(solids)) {
  if (device == nullptr) throw std::runtime_error("Embree: cannot start");
  scene.reset(rtcNewScene(device.get()));
  // Embree's robust flag would close every seam between triangles, for a quarter more time; without it one ray in a
  // million slips through. High build quality was measured to be slower in rooms.
  Attach();
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: error " + std::to_string(error));
  }
}

void SpatialWorld::Scene::Attach() {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
  if (vertices != nullptr && triangles != nullptr) {
    for (const Vector3d& v : mesh.vertices) vertices = std::ranges::copy(v.cast<float>(), vertices).out;
    for (const auto& t : mesh.triangles) triangles = std::ranges::copy(t, triangles).out;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
}

SpatialWorld::SpatialWorld(const std::vector<Solid>& solids, const Vector3d& p_inside)
    : scene_(std::make_unique<Scene>(solids)), p_inside_(p_inside) {
  for (const Vector3d& vertex : scene_->mesh.vertices) bounds_.extend(vertex);
}
SpatialWorld::~SpatialWorld() = default;
SpatialWorld::SpatialWorld(SpatialWorld&&) noexcept = default;
SpatialWorld& SpatialWorld::operator=(SpatialWorld&&) noexcept = default;

void SpatialWorld::CastRays(const SpatialRays& rays, SpatialHits& hits) const {
  Stream stream;
  const auto nothing = static_cast<unsigned>(scene_->facets.size() - 1);
  for (Eigen::Index first = 0; first < rays.size(); first += kStream) {
    stream.Cast(scene_->scene.get(), rays, hits, first, std::min(kStream, rays.size() - first), nothing);
  }
}

std::span<const Facet> SpatialWorld::facets() const { return scene_->facets; }

double SpatialWorld::Distance(const Vector3d& p_world, double max_distance_m) const {
  NearestSurface nearest{scene_->mesh, p_world, max_distance_m};
  const Eigen::Vector3f p = p_world.cast<float>();
  RTCPointQuery query{p.x(), p.y(), p.z(), 0.0F, static_cast<float>(max_distance_m)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->scene.get(), &query, &context, VisitTriangle, &nearest);
  return nearest.distance_m;
}

}  // namespace lcmslam
