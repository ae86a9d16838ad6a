#include "simulation/spatial_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/random/uniform_real_distribution.hpp>

namespace lcmslam {
namespace {

using Eigen::Vector3d;

constexpr int kLegsToStart = 3;
constexpr int kMaxTries = 2000;
constexpr double kMinLeg_m = 1.0;
constexpr double kMaxLeg_m = 8.0;
constexpr double kSurvey_m = 10.0;  // how far to look for the nearest surface
constexpr double kMinStride_m = 0.01;

double Uniform(double low, double high, Rng& rng) {
  return boost::random::uniform_real_distribution<double>(low, high)(rng);
}

}  // namespace

SpatialWay::SpatialWay(const SpatialWorld& world, const SpatialWayOptions& options, Rng& rng)
    : world_(world), options_(options), rng_(rng), position_(world.p_inside()), goal_(position_) {
  for (int leg = 0; leg < kLegsToStart; ++leg) {
    position_ = goal_;
    StartLeg();
  }
}

void SpatialWay::Advance(double step_m) {
  while (!blocked_) {
    const Vector3d to_goal = goal_ - position_;
    const double distance_m = to_goal.norm();
    if (step_m < distance_m) {
      position_ += step_m / distance_m * to_goal;
      return;
    }
    step_m -= distance_m;
    position_ = goal_;
    StartLeg();
  }
}

void SpatialWay::StartLeg() {
  for (int i = 0; i < kMaxTries; ++i) {
    const Vector3d goal = RandomGoal();
    if (!IsWithinBounds(goal) || !IsFree(goal)) continue;
    goal_ = goal;
    return;
  }
  blocked_ = true;
}

Vector3d SpatialWay::RandomGoal() {
  const double heading_rad = Uniform(0.0, 2.0 * std::numbers::pi, rng_);
  const double length_m = Uniform(kMinLeg_m, kMaxLeg_m, rng_);
  const double height_m = Uniform(options_.min_height_m, options_.max_height_m, rng_);
  return {position_.x() + length_m * std::cos(heading_rad), position_.y() + length_m * std::sin(heading_rad), height_m};
}

bool SpatialWay::IsWithinBounds(const Vector3d& goal) const {
  const Eigen::AlignedBox3d& bounds = world_.bounds();
  return Eigen::AlignedBox2d(bounds.min().head<2>(), bounds.max().head<2>()).contains(goal.head<2>());
}

// Whether the straight leg keeps its clearance: every stride is as long as the free space around it allows.
bool SpatialWay::IsFree(const Vector3d& goal) const {
  const Vector3d leg = goal - position_;
  const double length_m = leg.norm();
  double at_m = 0.0;
  while (true) {
    const double slack_m = world_.Distance(position_ + at_m / length_m * leg, kSurvey_m) - options_.clearance_m;
    if (slack_m < 0.0) return false;
    if (at_m >= length_m) return true;
    at_m = std::min(length_m, at_m + std::max(slack_m, kMinStride_m));
  }
}

}  // namespace lcmslam
