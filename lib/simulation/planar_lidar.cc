#include "simulation/planar_lidar.h"

#include <cmath>
#include <numbers>

#include <boost/random/normal_distribution.hpp>

#include "geometry/angles.h"
#include "simulation/cramer_rao.h"

namespace lcmslam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// A sector of `num_beams` beams symmetric about x.
PlanarLidarModel Sector(int num_beams, double step_deg, double turn_s, double min_range_m, double max_range_m) {
  const double step_rad = DegToRad(step_deg);
  return {.first_angle_rad = -0.5 * (num_beams - 1) * step_rad,
          .angle_step_rad = step_rad,
          .num_beams = num_beams,
          .turn_s = turn_s,
          .min_range_m = min_range_m,
          .max_range_m = max_range_m};
}

// As many beams as fit into one clockwise turn, from straight ahead.
PlanarLidarModel Rplidar(double samples_per_s, double turn_s) {
  const int num_beams = static_cast<int>(samples_per_s * turn_s);
  return {.first_angle_rad = 0.0,
          .angle_step_rad = -kTurn_rad / num_beams,
          .num_beams = num_beams,
          .turn_s = turn_s,
          .min_range_m = 0.15,
          .max_range_m = 12.0};
}

// A beam as it leaves the lidar, without its range yet.
Beam BeamOf(int i, const PlanarLidarOptions& options) {
  const PlanarLidarModel& model = options.model;
  const double angle_rad = WrapAngle(model.first_angle_rad + i * model.angle_step_rad);
  const double before_end_s = options.motion_distortion ? (model.num_beams - 1 - i) * model.beam_interval_s() : 0.0;
  return {.angle_rad = static_cast<float>(angle_rad), .dt_us = -static_cast<int32_t>(std::llround(1e6 * before_end_s))};
}

std::optional<SurfaceHit> NearestPerson(std::span<const Person> people, const Vector2d& origin,
                                        const Vector2d& direction, int64_t utime) {
  std::optional<SurfaceHit> nearest;
  for (const Person& person : people) {
    const std::optional<SurfaceHit> hit = person.CastRay(origin, direction, utime);
    if (hit && (!nearest || hit->range_m < nearest->range_m)) nearest = hit;
  }
  return nearest;
}

// The derivative of a range by the pose of the body (world axes, about the body's origin).
Vector3d RangeJacobian(const SurfaceHit& hit, const Vector2d& direction, const Vector2d& hit_from_body) {
  const double turning = hit.normal.y() * hit_from_body.x() - hit.normal.x() * hit_from_body.y();
  return -Vector3d(hit.normal.x(), hit.normal.y(), turning) / hit.normal.dot(direction);
}

}  // namespace

double PlanarLidarModel::beam_interval_s() const { return turn_s * std::abs(angle_step_rad) / kTurn_rad; }

double PlanarLidarModel::sweep_s() const { return (num_beams - 1) * beam_interval_s(); }

std::string PlanarLidarModel::Validate() const {
  if (num_beams < 1 || num_beams > 100'000) return "num_beams: must be in 1..100000";
  if (!std::isfinite(first_angle_rad)) return "first_angle_rad: must be finite";
  if (!(angle_step_rad != 0.0) || !std::isfinite(angle_step_rad)) return "angle_step_rad: must be finite, not 0";
  if (std::abs(angle_step_rad) * (num_beams - 1) > kTurn_rad) return "angle_step_rad: the beams exceed one turn";
  if (!(turn_s >= 1e-3 && turn_s <= 1e3)) return "turn_s: must be in 0.001..1000";
  if (!(min_range_m >= 0.0)) return "min_range_m: must not be negative";
  if (!(max_range_m > min_range_m) || !std::isfinite(max_range_m)) return "max_range_m: must exceed min_range_m";
  return "";
}

PlanarLidarModel HokuyoUrg04LxUg01() { return Sector(667, 240.0 / 666.0, 0.1, 0.02, 5.6); }

PlanarLidarModel HokuyoUtm30Lx() { return Sector(1081, 0.25, 0.025, 0.1, 30.0); }

PlanarLidarModel RplidarA1() { return Rplidar(8000.0, 1.0 / 5.5); }

PlanarLidarModel RplidarA2() { return Rplidar(8000.0, 0.1); }

std::string RangeNoise::Validate() const {
  if (!(sigma_m >= 0.0) || !std::isfinite(sigma_m)) return "sigma_m: must not be negative";
  if (!(relative_sigma >= 0.0) || !std::isfinite(relative_sigma)) return "relative_sigma: must not be negative";
  return "";
}

std::string PlanarLidarOptions::Validate() const {
  if (const std::string error = model.Validate(); !error.empty()) return "model." + error;
  if (const std::string error = noise.Validate(); !error.empty()) return "noise." + error;
  if (!T_body_lidar.IsFinite()) return "T_body_lidar: must be finite";
  return "";
}

SimulatedScan SimulateScan(const PlanarWorld& world, std::span<const Person> people, const PoseAtTime& T_world_body,
                           int64_t utime, const PlanarLidarOptions& options, Rng& rng) {
  const PlanarLidarModel& model = options.model;
  const Vector2d p_world_body = T_world_body(utime).translation();
  boost::random::normal_distribution<double> normal;
  Matrix3d information = Matrix3d::Zero();
  SimulatedScan result{.scan = {.utime = utime, .beams = {}}, .bound = {}};
  for (int i = 0; i < model.num_beams; ++i) {
    Beam& beam = result.scan.beams.emplace_back(BeamOf(i, options));
    const Pose2 T_world_lidar = T_world_body(utime + beam.dt_us) * options.T_body_lidar;
    // The angle as the message carries it, so that rounding it to float is no error of the scan.
    const double heading_rad = T_world_lidar.yaw() + beam.angle_rad;
    const Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
    const Vector2d& origin = T_world_lidar.translation();
    const std::optional<SurfaceHit> wall = world.CastRay(origin, direction, model.max_range_m);
    const std::optional<SurfaceHit> person = NearestPerson(people, origin, direction, utime + beam.dt_us);
    if (!wall && !person) continue;

    const bool ends_on_wall = wall && (!person || wall->range_m < person->range_m);
    const double true_range_m = ends_on_wall ? wall->range_m : person->range_m;
    const double sigma_m = options.noise.Sigma(true_range_m);
    const double range_m = true_range_m + sigma_m * normal(rng);
    if (range_m < model.min_range_m || range_m > model.max_range_m) continue;
    beam.range_m = static_cast<float>(range_m);
    if (!ends_on_wall) continue;
    const Vector2d hit_from_body = origin + true_range_m * direction - p_world_body;
    const Vector3d jacobian = RangeJacobian(*wall, direction, hit_from_body) / (options.noise.IsNone() ? 1.0 : sigma_m);
    information += jacobian * jacobian.transpose();
  }
  result.bound = CramerRaoBound(information);
  if (result.bound && options.noise.IsNone()) result.bound->setZero();
  return result;
}

}  // namespace lcmslam
