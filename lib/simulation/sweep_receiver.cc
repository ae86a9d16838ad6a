#include "simulation/sweep_receiver.h"

#include <cmath>
#include <limits>
#include <utility>

#include "simulation/cramer_rao.h"

namespace lcmslam {

SweepReceiver::SweepReceiver(std::span<const Facet> facets, const MultiLineLidarOptions& options, int64_t utime,
                             const Eigen::Vector3d& p_world_body, uint64_t seed, int index)
    : facets_(facets),
      options_(options),
      p_world_body_(p_world_body.cast<float>()),
      range_rng_(MakeRng(seed, RandomStream::kRange, static_cast<uint64_t>(index))),
      dropout_rng_(MakeRng(seed, RandomStream::kDropout, static_cast<uint64_t>(index))),
      sweep_{.utime = utime, .points = {}} {
  const MultiLineModel& model = options.model;
  sweep_.points.reserve(model.lasers.size() * static_cast<size_t>(1e6 * model.turn_s / model.firing_cycle_us + 1.0));
}

void SweepReceiver::Receive(const FiringBlock& block, const SpatialHits& hits, int64_t first_cycle, int num_cycles) {
  Measure(block, hits, num_cycles);
  signals_.resize(block.rays().size());
  for (Eigen::Index ray = 0; ray < block.rays().size(); ray += FiringBlock::kCycles) Judge(block, hits, ray);
  AddPoints(block, first_cycle, num_cycles);
}

// Noise is drawn for every shot in firing order, so that one shot's fate leaves the others alone.
void SweepReceiver::Measure(const FiringBlock& block, const SpatialHits& hits, int num_cycles) {
  constexpr float kLost = std::numeric_limits<float>::quiet_NaN();
  ranges_m_.setConstant(block.rays().size(), kLost);
  for (int cycle = 0; cycle < num_cycles; ++cycle) {
    for (size_t laser = 0; laser < options_.model.lasers.size(); ++laser) {
      const Eigen::Index ray = block.RayOf(laser, cycle);
      ranges_m_[ray] = static_cast<float>(hits.ranges_m[ray] + options_.range_sigma_m * normal_(range_rng_));
      const bool lost = options_.dropout_probability > 0.0 && uniform_(dropout_rng_) < options_.dropout_probability;
      if (lost) ranges_m_[ray] = kLost;
    }
  }
}

// Finds which of one laser's shots are seen, and what they say about the pose: the derivative of a range by the pose of
// the body (translation, then rotation about its origin; world axes).
void SweepReceiver::Judge(const FiringBlock& block, const SpatialHits& hits, Eigen::Index first_ray) {
  constexpr int kShots = FiringBlock::kCycles;
  using Lanes = Eigen::Array<float, kShots, 1>;
  using VectorLanes = Eigen::Array<float, kShots, 3>;
  VectorLanes normals;
  Lanes signals;
  for (int i = 0; i < kShots; ++i) {
    const Facet& facet = facets_[hits.facets[first_ray + i]];
    normals.row(i) = facet.normal;
    signals[i] = facet.reflectivity;
  }
  const auto origins = block.rays().origins.middleRows<kShots>(first_ray);
  const auto directions = block.rays().directions.middleRows<kShots>(first_ray);
  const Lanes true_ranges_m = hits.ranges_m.segment<kShots>(first_ray);
  const Lanes along_normals = (normals * directions).rowwise().sum();
  signals *= along_normals.abs();
  const auto reach_m = static_cast<float>(options_.model.max_range_m);
  const auto min_range_m = static_cast<float>(options_.model.min_range_m);
  const Eigen::Array<bool, kShots, 1> is_seen =
      true_ranges_m.square() <= reach_m * reach_m * signals && ranges_m_.segment<kShots>(first_ray) >= min_range_m;

  signals_.segment<kShots>(first_ray) = is_seen.select(signals, 0.0F);

  const Lanes weights = is_seen.select(-along_normals.inverse(), 0.0F);
  const Lanes seen_ranges_m = is_seen.select(true_ranges_m, 0.0F);
  Eigen::Array<float, kShots, 6> jacobians;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const auto lever = [&](int i) { return origins.col(i) + seen_ranges_m * directions.col(i) - p_world_body_[i]; };
    jacobians.col(axis) = weights * normals.col(axis);
    jacobians.col(3 + axis) = weights * (lever(next) * normals.col(last) - lever(last) * normals.col(next));
  }
  const Eigen::Matrix<double, kShots, 6> exact = jacobians.matrix().cast<double>();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) information_(i, j) += exact.col(i).dot(exact.col(j));
  }
}

void SweepReceiver::AddPoints(const FiringBlock& block, int64_t first_cycle, int num_cycles) {
  const MultiLineModel& model = options_.model;
  for (int cycle = 0; cycle < num_cycles; ++cycle) {
    const double cycle_us = static_cast<double>(first_cycle + cycle) * model.firing_cycle_us;
    for (size_t i = 0; i < model.lasers.size(); ++i) {
      const Eigen::Index ray = block.RayOf(i, cycle);
      if (signals_[ray] == 0.0F) continue;
      const Laser& laser = model.lasers[i];
      const Eigen::Vector3f along_beam = ranges_m_[ray] * block.Direction(i, cycle);
      const auto shot_utime = static_cast<int64_t>(cycle_us + laser.fire_delay_us + 0.5);
      const int64_t dt_us = options_.motion_distortion ? shot_utime - sweep_.utime : 0;
      sweep_.points.push_back({.x = along_beam.x(),
                               .y = along_beam.y(),
                               .z = along_beam.z() + static_cast<float>(laser.height_m),
                               .intensity = 255.0F * signals_[ray],
                               .ring = laser.ring,
                               .dt_us = static_cast<int32_t>(dt_us)});
    }
  }
}

SimulatedSweep SweepReceiver::Finish() {
  SimulatedSweep result{.sweep = std::move(sweep_),
                        .bound = CramerRaoBound<6>(information_.selfadjointView<Eigen::Lower>())};
  if (result.bound) *result.bound *= options_.range_sigma_m * options_.range_sigma_m;
  return result;
}

}  // namespace lcmslam
