#include "simulation/multi_line_lidar.h"

#include <cmath>
#include <numbers>

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

#include "simulation/cramer_rao.h"
#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// The lidar around the start of one firing cycle, to first order in time: exact to nanometres within a cycle. World
// frame.
struct CycleMotion {
  Vector3d origin = Vector3d::Zero();
  Matrix3d R_world_lidar = Matrix3d::Identity();
  Vector3d velocity_mps = Vector3d::Zero();
  Vector3d angular_velocity_radps = Vector3d::Zero();
};

CycleMotion Moving(const BodyState& body, const Pose3& T_body_lidar) {
  const Pose3 T_world_lidar = body.T_world_body * T_body_lidar;
  const Vector3d rate_radps = body.T_world_body.rotation * body.angular_velocity_radps;
  const Vector3d lever = body.T_world_body.rotation * T_body_lidar.translation;
  return {.origin = T_world_lidar.translation,
          .R_world_lidar = T_world_lidar.rotation.toRotationMatrix(),
          .velocity_mps = body.velocity_mps + rate_radps.cross(lever),
          .angular_velocity_radps = rate_radps};
}

CycleMotion Still(const BodyState& body, const Pose3& T_body_lidar) {
  const Pose3 T_world_lidar = body.T_world_body * T_body_lidar;
  return {.origin = T_world_lidar.translation, .R_world_lidar = T_world_lidar.rotation.toRotationMatrix()};
}

// The first cycle that starts in turn `index` or later.
int64_t FirstCycle(const MultiLineModel& model, int index) {
  return static_cast<int64_t>(std::ceil(1e6 * model.turn_s * index / model.firing_cycle_us - 1e-9));
}

// Beam directions at the start of a cycle that begins at azimuth 0, each already turned on by its own delay.
std::vector<Vector3d> BeamDirections(const MultiLineModel& model) {
  std::vector<Vector3d> directions;
  for (const Laser& laser : model.lasers) {
    const double azimuth_rad = laser.azimuth_rad - 1e-6 * kTurn_rad * laser.fire_delay_us / model.turn_s;
    directions.emplace_back(std::cos(laser.elevation_rad) * std::cos(azimuth_rad),
                            std::cos(laser.elevation_rad) * std::sin(azimuth_rad), std::sin(laser.elevation_rad));
  }
  return directions;
}

// The rays of one cycle.
void Aim(const MultiLineModel& model, const std::vector<Vector3d>& head_directions, const Matrix3d& R_lidar_head,
         const CycleMotion& lidar, std::vector<SpatialRay>& rays) {
  const Matrix3d R_world_head = lidar.R_world_lidar * R_lidar_head;
  for (size_t i = 0; i < rays.size(); ++i) {
    const double delay_s = 1e-6 * model.lasers[i].fire_delay_us;
    const Vector3d direction = R_world_head * head_directions[i];
    const Vector3d offset = model.lasers[i].height_m * lidar.R_world_lidar.col(2);
    rays[i].origin = (lidar.origin + delay_s * lidar.velocity_mps + offset).cast<float>();
    rays[i].direction = (direction + delay_s * lidar.angular_velocity_radps.cross(direction)).cast<float>();
  }
}

// Range along the beam and intensity as the sensor measures them; noise and dropout are drawn for every shot, so that
// one shot's fate leaves the others alone.
class Receiver {
 public:
  Receiver(const MultiLineLidarOptions& options, uint64_t seed, int index)
      : options_(options),
        range_rng_(MakeRng(seed, RandomStream::kRange, static_cast<uint64_t>(index))),
        dropout_rng_(MakeRng(seed, RandomStream::kDropout, static_cast<uint64_t>(index))) {}

  struct Echo {
    bool seen = false;
    double range_m = 0.0;
    double intensity = 0.0;
  };

  Echo Receive(const SpatialRay& ray, const SpatialHit& hit) {
    const double noise_m = options_.range_sigma_m * normal_(range_rng_);
    const bool dropped = uniform_(dropout_rng_) < options_.dropout_probability;
    if (dropped || !std::isfinite(hit.range_m)) return {};
    const double returned = hit.reflectivity * -hit.normal.dot(ray.direction);
    const double range_m = hit.range_m + noise_m;
    const bool too_weak = hit.range_m > options_.model.max_range_m * std::sqrt(returned);
    if (too_weak || range_m < options_.model.min_range_m) return {};
    return {true, range_m, 255.0 * returned};
  }

 private:
  const MultiLineLidarOptions& options_;
  Rng range_rng_;
  Rng dropout_rng_;
  boost::random::normal_distribution<double> normal_;
  boost::random::uniform_01<double> uniform_;
};

// The derivative of a range by the pose of the body (translation, then rotation about the body's origin; world axes).
Vector6d RangeJacobian(const SpatialRay& ray, const SpatialHit& hit, const Vector3d& p_world_body) {
  const Vector3d normal = hit.normal.cast<double>();
  const Vector3d direction = ray.direction.cast<double>();
  const Vector3d lever = ray.origin.cast<double>() + hit.range_m * direction - p_world_body;
  Vector6d jacobian;
  jacobian << normal, lever.cross(normal);
  return -jacobian / normal.dot(direction);
}

}  // namespace

std::string MultiLineLidarOptions::Validate() const {
  if (const std::string error = model.Validate(); !error.empty()) return "model." + error;
  if (!(range_sigma_m >= 0.0) || !std::isfinite(range_sigma_m)) return "range_sigma_m: must not be negative";
  if (!(dropout_probability >= 0.0 && dropout_probability <= 1.0)) return "dropout_probability: must be in 0..1";
  if (!T_body_lidar.IsFinite()) return "T_body_lidar: must be finite";
  return "";
}

SimulatedSweep SimulateSweep(const SpatialWorld& world, const SpatialMotion& motion, int index,
                             const MultiLineLidarOptions& options, uint64_t seed) {
  const MultiLineModel& model = options.model;
  const std::vector<Vector3d> head_directions = BeamDirections(model);
  const int64_t first_cycle = FirstCycle(model, index);
  const int64_t end_cycle = FirstCycle(model, index + 1);
  const double last_shot_us =
      static_cast<double>(end_cycle - 1) * model.firing_cycle_us + model.lasers.back().fire_delay_us;
  const BodyState body_at_end = motion.StateAt(1e-6 * last_shot_us);

  SimulatedSweep result;
  result.sweep.utime = std::llround(last_shot_us);
  result.sweep.points.reserve(static_cast<size_t>(end_cycle - first_cycle) * model.lasers.size());
  Receiver receiver(options, seed, index);
  Matrix6d information = Matrix6d::Zero();  // for a range noise of 1 m
  std::vector<SpatialRay> rays(model.lasers.size());
  std::vector<SpatialHit> hits(model.lasers.size());
  for (int64_t cycle = first_cycle; cycle < end_cycle; ++cycle) {
    const double cycle_us = static_cast<double>(cycle) * model.firing_cycle_us;
    const CycleMotion lidar = options.motion_distortion ? Moving(motion.StateAt(1e-6 * cycle_us), options.T_body_lidar)
                                                        : Still(body_at_end, options.T_body_lidar);
    const double azimuth_rad = -1e-6 * kTurn_rad * cycle_us / model.turn_s;
    const Matrix3d R_lidar_head = AngleAxisd(azimuth_rad, Vector3d::UnitZ()).toRotationMatrix();
    Aim(model, head_directions, R_lidar_head, lidar, rays);
    world.CastRays(rays, hits);
    for (size_t i = 0; i < rays.size(); ++i) {
      const Receiver::Echo echo = receiver.Receive(rays[i], hits[i]);
      if (!echo.seen) continue;
      const Vector3d along_beam = echo.range_m * (R_lidar_head * head_directions[i]);
      const Eigen::Vector3f p_lidar = (along_beam + model.lasers[i].height_m * Vector3d::UnitZ()).cast<float>();
      const int64_t shot_utime = std::llround(cycle_us + model.lasers[i].fire_delay_us);
      const int64_t dt_us = options.motion_distortion ? shot_utime - result.sweep.utime : 0;
      result.sweep.points.push_back({.x = p_lidar.x(),
                                     .y = p_lidar.y(),
                                     .z = p_lidar.z(),
                                     .intensity = static_cast<float>(echo.intensity),
                                     .ring = model.lasers[i].ring,
                                     .dt_us = static_cast<int32_t>(dt_us)});
      const Vector6d jacobian = RangeJacobian(rays[i], hits[i], body_at_end.T_world_body.translation);
      information.selfadjointView<Eigen::Lower>().rankUpdate(jacobian);
    }
  }
  result.bound = CramerRaoBound<6>(information.selfadjointView<Eigen::Lower>());
  if (result.bound) *result.bound *= options.range_sigma_m * options.range_sigma_m;
  return result;
}

}  // namespace lcmslam
