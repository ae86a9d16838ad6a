#include "simulation/planar_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <boost/random/uniform_real_distribution.hpp>

#include "geometry/angles.h"
#include "simulation/planar_free_space.h"
#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int64_t kStep_us = 10'000;
constexpr double kStep_s = 0.01;
constexpr int kStepsPerCommand = 10;
constexpr double kReach_m = 0.8;       // how far ahead on its way the robot looks
constexpr double kGoalRadius_m = 0.3;  // a goal counts as reached, without stopping there
constexpr int kGoalTrials = 10;
constexpr double kTurnTime_s = 0.6;         // a heading error is turned off in about this time
constexpr double kSlowestCruise = 0.5;      // each goal is approached at a random share of the top speed, at least this
constexpr double kMeanderPatience_s = 2.0;  // an omnidirectional robot changes its yaw rate that often
constexpr double kSpeedShares[] = {1.0, 0.7, 0.4, 0.2, 0.0};  // tried in turn until one is safe

// Linear: (forward, 0) of the body if differential, world axes if omnidirectional.
struct Velocity {
  Vector2d linear_mps = Vector2d::Zero();
  double yaw_rate_radps = 0.0;
};

struct State {
  Pose2 T_world_body;
  Velocity velocity;
};

class Driver {
 public:
  Driver(const PlanarFreeSpace& space, const PlanarDriveOptions& options, uint64_t seed)
      : space_(space), options_(options), rng_(MakeRng(seed, RandomStream::kMotion)) {}

  // One command's worth of body twists, one for each step.
  void Advance(State& state, std::vector<Vector3d>& twists) {
    ChooseGoal(state);
    const Velocity command = SafeCommand(state, WantedVelocity(state));
    for (int i = 0; i < kStepsPerCommand; ++i) twists.push_back(Step(state, command));
  }

 private:
  double Uniform(double low, double high) { return boost::random::uniform_real_distribution<double>(low, high)(rng_); }

  void ChooseGoal(const State& state) {
    if (guide_ && (goal_ - state.T_world_body.translation()).norm() > kGoalRadius_m) return;
    goal_ = GoalAhead(state.T_world_body);
    guide_.emplace(space_, goal_);
    cruise_mps_ = options_.max_speed_mps * Uniform(kSlowestCruise, 1.0);
  }

  // Prefers goals in front: turning on the spot takes long.
  Vector2d GoalAhead(const Pose2& T_world_body) {
    Vector2d goal = space_.RandomPlace(rng_);
    const Pose2 T_body_world = T_world_body.inverse();
    for (int i = 0; i < kGoalTrials && (T_body_world * goal).x() < kGoalRadius_m; ++i) goal = space_.RandomPlace(rng_);
    return goal;
  }

  Velocity WantedVelocity(const State& state) {
    const Vector2d p = state.T_world_body.translation();
    const Vector2d way = guide_->Ahead(p, kReach_m) - p;
    if (options_.drive == PlanarDrive::kOmnidirectional) return {cruise_mps_ * way.stableNormalized(), Meander()};
    return FollowWay(way, state.T_world_body.yaw());
  }

  // As fast as the circle to the point ahead allows (pure pursuit); on the spot if that lies behind.
  Velocity FollowWay(const Vector2d& way, double yaw_rad) const {
    const double error_rad = WrapAngle(std::atan2(way.y(), way.x()) - yaw_rad);
    const double max_rate = options_.max_yaw_rate_radps;
    const double circle_mps = max_rate * way.norm() / std::max(2.0 * std::abs(std::sin(error_rad)), 1e-6);
    const double speed_mps = std::cos(error_rad) > 0.0 ? std::min(cruise_mps_, circle_mps) : 0.0;
    return {{speed_mps, 0.0}, std::clamp(error_rad / kTurnTime_s, -max_rate, max_rate)};
  }

  double Meander() {
    if (Uniform(0.0, 1.0) < kStepsPerCommand * kStep_s / kMeanderPatience_s) {
      meander_radps_ = Uniform(-options_.max_yaw_rate_radps, options_.max_yaw_rate_radps);
    }
    return meander_radps_;
  }

  // Braking is safe whenever the command before was found safe.
  Velocity SafeCommand(const State& state, const Velocity& wanted) const {
    for (const double share : kSpeedShares) {
      const Velocity command{share * wanted.linear_mps, wanted.yaw_rate_radps};
      if (IsSafe(state, command)) return command;
    }
    return {};
  }

  bool IsSafe(State state, const Velocity& command) const {
    for (int i = 0; i < kStepsPerCommand; ++i) {
      Step(state, command);
      if (!space_.Contains(state.T_world_body.translation())) return false;
    }
    while (!state.velocity.linear_mps.isZero(0.0)) {
      Step(state, {});
      if (!space_.Contains(state.T_world_body.translation())) return false;
    }
    return true;
  }

  // Moves for one step towards the commanded velocity as fast as the limits allow. Returns the body twist.
  Vector3d Step(State& state, const Velocity& command) const {
    const Vector2d change_mps = command.linear_mps - state.velocity.linear_mps;
    const double max_change_mps = options_.max_acceleration_mps2 * kStep_s;
    const double max_turn_change_radps = options_.max_yaw_acceleration_radps2 * kStep_s;
    const bool reaches_command = change_mps.norm() <= max_change_mps;
    state.velocity.linear_mps =
        reaches_command ? command.linear_mps : state.velocity.linear_mps + max_change_mps * change_mps.normalized();
    state.velocity.yaw_rate_radps += std::clamp(command.yaw_rate_radps - state.velocity.yaw_rate_radps,
                                                -max_turn_change_radps, max_turn_change_radps);
    const Vector3d twist = BodyTwist(state);
    state.T_world_body = state.T_world_body * Pose2::Exp(twist * kStep_s);
    return twist;
  }

  Vector3d BodyTwist(const State& state) const {
    const double rate_radps = state.velocity.yaw_rate_radps;
    const Vector2d& v = state.velocity.linear_mps;
    if (options_.drive == PlanarDrive::kDifferential) return {v.x(), v.y(), rate_radps};
    const Pose2 T_body_world(0.0, 0.0, -(state.T_world_body.yaw() + 0.5 * rate_radps * kStep_s));  // amid the step
    const Vector2d v_body = T_body_world * v;
    return {v_body.x(), v_body.y(), rate_radps};
  }

  const PlanarFreeSpace& space_;
  const PlanarDriveOptions& options_;
  Rng rng_;
  std::optional<PlanarFreeSpace::Guide> guide_;
  Vector2d goal_ = Vector2d::Zero();
  double cruise_mps_ = 0.0;
  double meander_radps_ = 0.0;
};

std::string CheckLimit(const char* field, double value, bool may_be_zero) {
  if (std::isfinite(value) && (value > 0.0 || (may_be_zero && value == 0.0))) return "";
  return std::string(field) + (may_be_zero ? ": must not be negative" : ": must be positive");
}

}  // namespace

std::string PlanarDriveOptions::Validate() const {
  for (const std::string& error :
       {CheckLimit("max_speed_mps", max_speed_mps, true), CheckLimit("max_yaw_rate_radps", max_yaw_rate_radps, true),
        CheckLimit("max_acceleration_mps2", max_acceleration_mps2, false),
        CheckLimit("max_yaw_acceleration_radps2", max_yaw_acceleration_radps2, false),
        CheckLimit("clearance_m", clearance_m, true)}) {
    if (!error.empty()) return error;
  }
  return "";
}

std::optional<PlanarMotion> DriveAround(const PlanarWorld& world, double duration_s, int64_t start_utime,
                                        const PlanarDriveOptions& options, uint64_t seed) {
  // Positions are checked after each step; in between the robot may cut a corner by half a step.
  const PlanarFreeSpace space(world, options.clearance_m + 0.5 * options.max_speed_mps * kStep_s);
  if (space.empty()) return std::nullopt;
  Rng rng = MakeRng(seed, RandomStream::kStart);
  const Vector2d start = space.RandomPlace(rng);
  const double yaw_rad = boost::random::uniform_real_distribution<double>(-std::numbers::pi, std::numbers::pi)(rng);

  State state{.T_world_body = Pose2(start, yaw_rad), .velocity = {}};
  const Pose2 T_world_body_start = state.T_world_body;
  Driver driver(space, options, seed);
  std::vector<Vector3d> twists;
  while (static_cast<double>(twists.size()) * kStep_s < duration_s) driver.Advance(state, twists);
  return PlanarMotion(start_utime, kStep_us, T_world_body_start, std::move(twists));
}

}  // namespace lcmslam
