#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "simulation/planar_motion.h"
#include "simulation/planar_world.h"

namespace lcmslam {

// A person as a planar lidar sees one: a disc that walks.
struct Person {
  double radius_m = 0.25;
  PlanarMotion motion;

  // As PlanarWorld::CastRay, with the person where it is at `utime`. None from inside.
  [[nodiscard]] std::optional<SurfaceHit> CastRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                                  int64_t utime) const;
};

struct PlanarPeopleOptions {
  int count = 0;
  double radius_m = 0.25;
  double speed_mps = 1.2;         // faster than the robot, so that they can get out of its way
  double robot_distance_m = 0.7;  // between centres; people wait, or step aside, to keep it

  std::string Validate() const;
};

// People who walk from one random place to the next while the robot drives, and give way to it; they walk through each
// other. Where the robot corners one against a wall, the distance may fall below the wanted one. None where the world
// has no room for them. Deterministic in the seed.
[[nodiscard]] std::vector<Person> SimulatePeople(const PlanarWorld& world, const PlanarMotion& robot,
                                                 const PlanarPeopleOptions& options, uint64_t seed);

}  // namespace lcmslam
