#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "baselines/cloud3d_filters.h"
#include "baselines/cloud3d_icp.h"
#include "baselines/cloud3d_map.h"
#include "baselines/tracking.h"
#include "geometry/pose3.h"
#include "lidar/sweep.h"

namespace lcmslam::cloud3d {

struct Options {
  FilterOptions filter = {};
  double reading_ratio = 0.75;  // of the filtered points, drawn at random for ICP; the map is offered all of them
  IcpOptions icp = {};
  MapOptions map = {};
  double update_distance_m = 0.5;  // the map is offered a sweep after so much motion ...
  double update_angle_rad = 0.3;   // ... or so much rotation
  double max_gap_s = 1.0;          // after a longer silence the old velocity is forgotten
  bool reach_last_point = true;    // false: as in the original, the pose is where the sweep is seen from on average
  uint64_t seed = 1;               // of the random samples
  bool localize_only = false;      // the map stays as it is

  std::string Validate() const;  // "" or "field: reason"
};

using Status = TrackingStatus;

enum class Stage { kFilter, kIcp, kGrowMap };
inline constexpr std::array kStageNames = {"filter", "icp", "grow map"};
inline constexpr size_t kNumStages = kStageNames.size();

// Body = lidar; skipped are sweeps of fewer than 100 returns. See IcpResult.
struct Result : Tracked<Pose3, 6> {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          // m/s, map frame; from the last two poses
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // rad/s, map frame
  int map_points_added = 0;
  std::array<double, kNumStages> stage_ms{};  // zeros without a stopwatch
};

// Point cloud SLAM after libpointmatcher's mapper, the baseline of NOctoSLAM. As in the original a sweep is rigid, and
// registered to where the lidar was at the mean time of its points; from there to the last point, and to the next
// sweep, it is moved with constant velocity, to the next sweep with odometry where there is any. Map frame = the
// lidar's frame at the first sweep, unless SetPose() was called before. Not thread-safe. Same calls, same results, bit
// for bit.
class Pipeline {
 public:
  // `options` must be valid.
  explicit Pipeline(const Options& options);

  // Any number of points, any values, any stamp: those matter to predictions only.
  // T_before_now: the motion since the last sweep, where it is known.
  [[nodiscard]] Result Process(const Sweep& sweep, const std::optional<Pose3>& T_before_now = std::nullopt);

  // Forgets the map and all motion.
  void Reset();
  // Continues from there, at rest; the map stays.
  void SetPose(const Pose3& T_map_body);
  void SetLocalizeOnly(bool localize_only) { options_.localize_only = localize_only; }

  // A monotonic clock in milliseconds for Result::stage_ms; never influences anything else.
  void SetStopwatch(std::function<double()> now_ms) { now_ms_ = std::move(now_ms); }

  const Options& options() const { return options_; }
  const Map& map() const { return map_; }

 private:
  Pose3 Predict(int64_t utime) const;
  bool MovedEnough() const;
  Result Locate(const Cloud& cloud_body, const Pose3& T_map_body_guess);
  Pose3 PoseAtLastPoint(const Sweep& sweep) const;
  void MoveTo(int64_t utime, const Pose3& T_map_body);
  void SetVelocity(Result& result) const;

  Options options_;
  Map map_;
  std::mt19937_64 random_;
  Pose3 T_map_body_;                       // of the last sweep as a whole
  std::optional<Pose3> T_map_body_grown_;  // where the map last grew; none: nowhere
  std::optional<int64_t> utime_;           // of T_map_body_; none: no sweep yet
  Pose3 T_before_now_;                     // the last motion ...
  double motion_s_ = 0.0;                  // ... and how long it took; 0: unknown
  std::function<double()> now_ms_;
};

}  // namespace lcmslam::cloud3d
