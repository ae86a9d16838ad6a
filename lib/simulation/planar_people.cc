#include "simulation/planar_people.h"

#include <cmath>
#include <numbers>

#include "simulation/planar_free_space.h"
#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

constexpr int64_t kStep_us = 100'000;
constexpr double kStep_s = 0.1;
constexpr double kReach_m = 1.0;  // how far ahead on its way a person looks
constexpr double kGoalRadius_m = 0.3;
constexpr int kStartTrials = 10;
constexpr int kWaysOut = 16;  // directions in which a person looks for a way out

class Walker {
 public:
  Walker(const PlanarFreeSpace& space, const PlanarMotion& robot, const PlanarPeopleOptions& options, Rng& rng)
      : space_(space), robot_(robot), options_(options), rng_(rng) {}

  Person Walk() {
    const Vector2d start = StartAwayFromRobot();
    Vector2d p = start;
    std::vector<Eigen::Vector3d> twists;
    for (int64_t utime = robot_.start_utime(); utime < robot_.end_utime(); utime += kStep_us) {
      const Vector2d velocity = ChooseVelocity(p, utime + kStep_us);
      p += kStep_s * velocity;
      twists.emplace_back(velocity.x(), velocity.y(), 0.0);
    }
    return {options_.radius_m, PlanarMotion(robot_.start_utime(), kStep_us, Pose2(start, 0.0), std::move(twists))};
  }

 private:
  double RobotDistance(const Vector2d& p, int64_t utime) const {
    return (robot_.PoseAt(utime).translation() - p).norm();
  }

  Vector2d StartAwayFromRobot() {
    Vector2d start = space_.RandomPlace(rng_);
    for (int i = 0; i < kStartTrials; ++i) {
      const Vector2d other = space_.RandomPlace(rng_);
      if (RobotDistance(other, robot_.start_utime()) > RobotDistance(start, robot_.start_utime())) start = other;
    }
    return start;
  }

  // On towards the goal, or wait, or aside: the first that keeps the distance, else what keeps most of it.
  Vector2d ChooseVelocity(const Vector2d& p, int64_t arrival_utime) {
    std::vector<Vector2d> choices{Onwards(p), Vector2d::Zero()};
    for (int i = 0; i < kWaysOut; ++i) {
      const double heading_rad = 2.0 * std::numbers::pi * i / kWaysOut;
      choices.push_back(options_.speed_mps * Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
    }
    Vector2d best = Vector2d::Zero();
    double best_distance_m = 0.0;
    for (const Vector2d& velocity : choices) {
      const Vector2d next = p + kStep_s * velocity;
      const double distance_m = RobotDistance(next, arrival_utime);
      if (!space_.Contains(next) || distance_m <= best_distance_m) continue;
      best = velocity;
      best_distance_m = distance_m;
      if (distance_m >= options_.robot_distance_m) break;
    }
    return best;
  }

  Vector2d Onwards(const Vector2d& p) {
    if (!guide_ || (goal_ - p).norm() < kGoalRadius_m) {
      goal_ = space_.RandomPlace(rng_);
      guide_.emplace(space_, goal_);
    }
    return options_.speed_mps * (guide_->Ahead(p, kReach_m) - p).stableNormalized();
  }

  const PlanarFreeSpace& space_;
  const PlanarMotion& robot_;
  const PlanarPeopleOptions& options_;
  Rng& rng_;
  std::optional<PlanarFreeSpace::Guide> guide_;
  Vector2d goal_ = Vector2d::Zero();
};

}  // namespace

std::optional<SurfaceHit> Person::CastRay(const Vector2d& origin, const Vector2d& direction, int64_t utime) const {
  const Vector2d to_center = motion.PoseAt(utime).translation() - origin;
  const double along_m = to_center.dot(direction);
  const double squared_miss = to_center.squaredNorm() - along_m * along_m;
  if (to_center.norm() <= radius_m || along_m < 0.0 || squared_miss > radius_m * radius_m) return std::nullopt;
  const double range_m = along_m - std::sqrt(radius_m * radius_m - squared_miss);
  return SurfaceHit{range_m, (range_m * direction - to_center) / radius_m};
}

std::string PlanarPeopleOptions::Validate() const {
  if (count < 0 || count > 100) return "count: must be in 0..100";
  if (!(radius_m > 0.0) || !std::isfinite(radius_m)) return "radius_m: must be positive";
  if (!(speed_mps >= 0.0) || !std::isfinite(speed_mps)) return "speed_mps: must not be negative";
  if (!(robot_distance_m >= 0.0) || !std::isfinite(robot_distance_m)) return "robot_distance_m: must not be negative";
  return "";
}

std::vector<Person> SimulatePeople(const PlanarWorld& world, const PlanarMotion& robot,
                                   const PlanarPeopleOptions& options, uint64_t seed) {
  std::vector<Person> people;
  if (options.count == 0) return people;
  const PlanarFreeSpace space(world, options.radius_m);
  if (space.empty()) return people;
  for (int i = 0; i < options.count; ++i) {
    Rng rng = MakeRng(seed, RandomStream::kPeople, static_cast<uint64_t>(i));
    people.push_back(Walker(space, robot, options, rng).Walk());
  }
  return people;
}

}  // namespace lcmslam
