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

constexpr size_t kPacket = 16;
constexpr char kDeviceConfig[] = "threads=1,isa=sse4.2";

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
  std::span<const Solid> solids;
  Vector3d p;
  double distance_m;
};

bool VisitTriangle(RTCPointQueryFunctionArguments* visit) {
  auto& nearest = *static_cast<NearestSurface*>(visit->userPtr);
  const TriangleMesh& mesh = nearest.solids[visit->geomID].mesh;
  const auto& [a, b, c] = mesh.triangles[visit->primID];
  const double distance_m =
      (ClosestPoint(nearest.p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) - nearest.p).norm();
  if (distance_m >= nearest.distance_m) return false;
  nearest.distance_m = distance_m;
  visit->query->radius = static_cast<float>(distance_m);
  return true;
}

}  // namespace

struct SpatialWorld::Scene {
  std::vector<Solid> solids;  // by geomID
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device{rtcNewDevice(kDeviceConfig), rtcReleaseDevice};
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene{nullptr, rtcReleaseScene};

  explicit Scene(std::vector<Solid> solids_in);
  void Attach(unsigned geometry_id, const TriangleMesh& mesh);
};

SpatialWorld::Scene::Scene(std::vector<Solid> solids_in) : solids(std::move(solids_in)) {
  if (device == nullptr) throw std::runtime_error("Embree: cannot start");
  scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  for (unsigned i = 0; i < solids.size(); ++i) Attach(i, solids[i].mesh);
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: error " + std::to_string(error));
  }
}

void SpatialWorld::Scene::Attach(unsigned geometry_id, const TriangleMesh& mesh) {
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
  rtcAttachGeometryByID(scene.get(), geometry, geometry_id);
  rtcReleaseGeometry(geometry);
}

SpatialWorld::SpatialWorld(std::vector<Solid> solids, const Vector3d& p_inside)
    : scene_(std::make_unique<Scene>(std::move(solids))), p_inside_(p_inside) {}
SpatialWorld::~SpatialWorld() = default;
SpatialWorld::SpatialWorld(SpatialWorld&&) noexcept = default;
SpatialWorld& SpatialWorld::operator=(SpatialWorld&&) noexcept = default;

void SpatialWorld::CastRays(std::span<const SpatialRay> rays, std::span<SpatialHit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit16 packet{};
  for (size_t first = 0; first < rays.size(); first += kPacket) {
    const size_t count = std::min(kPacket, rays.size() - first);
    alignas(64) std::array<int, kPacket> valid{};  // -1: valid
    for (size_t i = 0; i < count; ++i) {
      const SpatialRay& ray = rays[first + i];
      valid[i] = -1;
      packet.ray.org_x[i] = ray.origin.x();
      packet.ray.org_y[i] = ray.origin.y();
      packet.ray.org_z[i] = ray.origin.z();
      packet.ray.dir_x[i] = ray.direction.x();
      packet.ray.dir_y[i] = ray.direction.y();
      packet.ray.dir_z[i] = ray.direction.z();
      packet.ray.tnear[i] = 0.0F;
      packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet.ray.mask[i] = ~0U;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid.data(), scene_->scene.get(), &context, &packet);
    for (size_t i = 0; i < count; ++i) {
      SpatialHit& hit = hits[first + i];
      hit.range_m = packet.ray.tfar[i];
      const unsigned solid = packet.hit.geomID[i];
      if (solid == RTC_INVALID_GEOMETRY_ID) continue;
      hit.normal = Eigen::Vector3f(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]).normalized();
      if (hit.normal.dot(rays[first + i].direction) > 0.0F) hit.normal = -hit.normal;
      hit.reflectivity = scene_->solids[solid].reflectivity;
    }
  }
}

double SpatialWorld::Distance(const Vector3d& p_world, double max_distance_m) const {
  NearestSurface nearest{scene_->solids, p_world, max_distance_m};
  const Eigen::Vector3f p = p_world.cast<float>();
  RTCPointQuery query{p.x(), p.y(), p.z(), 0.0F, static_cast<float>(max_distance_m)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->scene.get(), &query, &context, VisitTriangle, &nearest);
  return nearest.distance_m;
}

std::span<const Solid> SpatialWorld::solids() const { return scene_->solids; }

}  // namespace lcmslam
