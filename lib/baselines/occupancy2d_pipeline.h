#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "baselines/occupancy2d_grid.h"
#include "baselines/occupancy2d_match.h"
#include "baselines/occupancy2d_odometry.h"
#include "baselines/tracking.h"
#include "geometry/pose2.h"
#include "lidar/occupancy_grid.h"
#include "lidar/planar_scan.h"

namespace lcmslam::occupancy2d {

struct Options {
  LogOddsGrid::Options grid = {};  // of the finest level; every further one has cells twice as large
  int levels = 3;
  MatchOptions match = {};
  double update_distance_m = 0.4;  // the map is written after so much motion ...
  double update_angle_rad = 0.9;   // ... or so much rotation
  double min_range_m = 0.02;       // nearer returns are ignored
  double max_range_m = 30.0;       // farther ones, too
  Pose2 T_body_lidar = {};         // where the lidar sits
  Pose2 T_map_body_initial = {};   // the first scan's pose
  bool localize_only = false;      // never write into the map

  std::string Validate() const;  // "" or "field: reason"
};

using Status = TrackingStatus;

enum class Stage { kPrepare, kMatch, kWriteMap };
inline constexpr std::array kStageNames = {"prepare", "match", "write map"};
inline constexpr size_t kNumStages = kStageNames.size();

// Before the first scan is placed the guess is the initial pose. Lost is also who has left the map's extent; skipped
// are scans of fewer than 3 returns. See MatchResult.
struct Result : Tracked<Pose2, 3> {
  bool map_written = false;
  std::array<double, kNumStages> stage_ms{};  // zeros without a stopwatch
};

// Occupancy grid SLAM after Hector SLAM (Kohlbrecher et al., SSRR 2011), the baseline of 2D-SDF-SLAM. As in the
// original a scan is rigid, beam times are not used, and nothing is said of the motion between scans but what odometry
// says. Not thread-safe. Same calls, same results, bit for bit.
class Pipeline {
 public:
  // `options` must be valid.
  explicit Pipeline(const Options& options);

  // Any number of beams, any values: whatever is not a finite range within the limits is no return. Stamps matter to
  // odometry only.
  [[nodiscard]] Result Process(const PlanarScan& scan);

  // Optional; see OdometryGuess.
  void AddOdometry(int64_t utime, const Pose2& T_odom_body) { odometry_.Add(utime, T_odom_body); }

  // Before the first scan.
  void SetMounting(const Pose2& T_body_lidar) { options_.T_body_lidar = T_body_lidar; }
  // Forgets the map and all motion.
  void Reset();
  // Continues from there; the map stays.
  void SetPose(const Pose2& T_map_body) { T_map_body_ = T_map_body; }
  void SetLocalizeOnly(bool localize_only) { options_.localize_only = localize_only; }

  // A monotonic clock in milliseconds for Result::stage_ms; never influences anything else.
  void SetStopwatch(std::function<double()> now_ms) { now_ms_ = std::move(now_ms); }

  const Options& options() const { return options_; }
  // The finest level.
  const LogOddsGrid& map() const { return levels_.front(); }

 private:
  Result Locate(const std::vector<Eigen::Vector2d>& p_body, const Pose2& T_map_body_guess) const;
  std::vector<Eigen::Vector2d> EndPoints(const PlanarScan& scan) const;
  bool MovedEnough() const;
  void WriteMap(const std::vector<Eigen::Vector2d>& p_body);

  Options options_;
  std::vector<LogOddsGrid> levels_;  // fine to coarse
  Pose2 T_map_body_;
  std::optional<Pose2> T_map_body_written_;  // where the map was last written; none: nothing is
  OdometryGuess odometry_;
  std::function<double()> now_ms_;
};

}  // namespace lcmslam::occupancy2d
