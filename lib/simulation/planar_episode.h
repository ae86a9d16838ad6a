#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose2.h"
#include "simulation/planar_drive.h"
#include "simulation/planar_lidar.h"
#include "simulation/planar_motion.h"
#include "simulation/planar_odometry.h"
#include "simulation/planar_people.h"
#include "simulation/planar_world.h"

namespace lcmslam {

struct PlanarEpisodeOptions {
  uint64_t seed = 1;  // start, motion and every noise; the world is the caller's
  double duration_s = 60.0;
  int64_t start_utime = 1'000'000;  // us; the robot starts to move, the first beam is measured
  PlanarLidarOptions lidar = {};
  PlanarDriveOptions drive = {};
  OdometryOptions odometry = {};
  PlanarPeopleOptions people = {};

  std::string Validate() const;
};

// What the world has become at a time: furniture was moved.
struct WorldChange {
  double at_s = 0.0;  // since the start; what a beam meets is decided by its scan's utime
  PlanarWorld world;
};

struct PlanarFrame {
  PlanarScan scan;
  Pose2 T_world_body;                                    // at scan.utime
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s; at scan.utime
  std::optional<Eigen::Matrix3d> bound;                  // Cramer-Rao, see SimulatedScan
};

// A seeded drive of a robot with a planar lidar through a world. Same world and options, same bytes.
//   const std::optional<PlanarEpisode> episode = PlanarEpisode::Create(Room5World(), {.seed = 3});
//   for (int i = 0; i < episode->num_frames(); ++i) const PlanarFrame frame = episode->Frame(i);
class PlanarEpisode {
 public:
  // Robot and people keep clear of what stands before the change and of what stands after it. None where the options
  // are not valid or the world has no free space of the wanted clearance.
  [[nodiscard]] static std::optional<PlanarEpisode> Create(PlanarWorld world, const PlanarEpisodeOptions& options,
                                                           std::optional<WorldChange> change = std::nullopt);

  int num_frames() const;
  // Scan i and its truth, in any order; pure, hence safe from several threads.
  [[nodiscard]] PlanarFrame Frame(int i) const;

  const PlanarWorld& world() const { return world_; }  // at the start
  const PlanarMotion& motion() const { return motion_; }
  const std::vector<OdometrySample>& odometry() const { return odometry_; }
  const std::vector<Person>& people() const { return people_; }
  const PlanarEpisodeOptions& options() const { return options_; }

 private:
  PlanarEpisode(PlanarWorld world, std::optional<WorldChange> change, PlanarMotion motion, std::vector<Person> people,
                const PlanarEpisodeOptions& options);
  const PlanarWorld& WorldAt(int64_t utime) const;

  PlanarWorld world_;
  std::optional<WorldChange> change_;
  PlanarMotion motion_;
  PlanarEpisodeOptions options_;
  std::vector<OdometrySample> odometry_;
  std::vector<Person> people_;
};

}  // namespace lcmslam
