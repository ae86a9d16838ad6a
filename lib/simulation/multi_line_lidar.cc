#include "simulation/multi_line_lidar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/firing_block.h"
#include "simulation/sweep_receiver.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

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

// The cycles and the time of a turn.
struct Turn {
  Turn(const MultiLineModel& model, int index)
      : first_cycle(FirstCycle(model, index)),
        end_cycle(FirstCycle(model, index + 1)),
        last_shot_us(static_cast<double>(end_cycle - 1) * model.firing_cycle_us + model.lasers.back().fire_delay_us) {}

  // The first cycle that starts in turn `index` or later.
  static int64_t FirstCycle(const MultiLineModel& model, int index) {
    return static_cast<int64_t>(std::ceil(1e6 * model.turn_s * index / model.firing_cycle_us - 1e-9));
  }

  int64_t first_cycle;
  int64_t end_cycle;
  double last_shot_us;
};

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
  const Turn turn(model, index);
  const BodyState body_at_end = motion.StateAt(1e-6 * turn.last_shot_us);
  SweepReceiver receiver(world.facets(), options, std::llround(turn.last_shot_us), body_at_end.T_world_body.translation,
                         seed, index);
  FiringBlock block(model);
  SpatialHits hits(block.rays().size());
  for (int64_t first_cycle = turn.first_cycle; first_cycle < turn.end_cycle; first_cycle += FiringBlock::kCycles) {
    for (int i = 0; i < FiringBlock::kCycles; ++i) {
      const double cycle_s = 1e-6 * static_cast<double>(first_cycle + i) * model.firing_cycle_us;
      const double head_azimuth_rad = -2.0 * std::numbers::pi * cycle_s / model.turn_s;
      block.SetCycle(i,
                     options.motion_distortion ? Moving(motion.StateAt(cycle_s), options.T_body_lidar)
                                               : Still(body_at_end, options.T_body_lidar),
                     head_azimuth_rad);
    }
    block.Aim();
    world.CastRays(block.rays(), hits);
    const auto num_cycles = std::min<int64_t>(FiringBlock::kCycles, turn.end_cycle - first_cycle);
    receiver.Receive(block, hits, first_cycle, static_cast<int>(num_cycles));
  }
  return receiver.Finish();
}

}  // namespace lcmslam
