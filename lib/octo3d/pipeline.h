#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"
#include "lidar/sweep.h"
#include "octo3d/motion.h"
#include "octo3d/options.h"
#include "octo3d/patches.h"
#include "octo3d/registration.h"
#include "octo3d/surfel_map.h"

namespace lcmslam::octo3d {

enum class SweepStatus {
  kStarted,   // the first sweep made the map
  kTracking,  // registered and believed
  kDoubtful,  // registered badly or not at all: the pose is the prediction, the map was not touched
  kNoPoints,  // nothing usable in the sweep: the pose is the prediction
  kStale,     // not later than the sweep before: ignored
};

// What else is known of the motion since the last sweep, in the lidar's frame at that time.
struct MotionHint {
  std::optional<Eigen::Quaterniond> rotation;  // from a gyroscope
  std::optional<Pose3> odometry;
};

enum class Stage { kCondense, kRegister, kInsert };
inline constexpr std::array kStageNames = {"condense", "register", "insert"};

struct Result {
  SweepStatus status = SweepStatus::kNoPoints;
  int64_t utime = 0;  // us; of the pose: the sweep's last point, but of the sweep before when kStale
  Pose3 T_map_body;   // body = lidar
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          // m/s, map frame
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // rad/s, map frame
  Matrix6 covariance = Matrix6::Zero();  // of the pose: translation, rotation vector, both in the map frame
  Directions unobservable{6, 0};         // what the sweep does not show: the motion prior decides there
  int iterations = 0;
  int patches = 0;
  int matched = 0;
  double inlier_ratio = 0.0;
  double residual_m = 0.0;
  bool searched = false;  // the prediction had led nowhere: found by the wider search
  bool inserted = false;
  bool began_anew = false;  // the map of the sweep before was replaced: that one had been in motion
  std::array<double, kStageNames.size()> stage_ms{};  // zeros without a stopwatch
};

// NOctoSLAM: registers each sweep of a multi-line lidar to a surfel octree and adds it. Map frame = the lidar's frame
// at the end of the first sweep, unless SetPose() was called before. Not thread-safe; same input, same output, with
// any number of Options::threads.
class Pipeline {
 public:
  explicit Pipeline(const Options& options);  // Validate()d
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // Points that are not finite or out of range are skipped. hint: motion since the sweep processed last.
  Result Process(const Sweep& sweep, const MotionHint& hint = {});

  void Reset();                           // empties the map, forgets the motion
  void SetPose(const Pose3& T_map_body);  // at rest there; keeps the map
  void SetLocalizeOnly(bool localize_only) { options_.localize_only = localize_only; }
  void SetMap(SurfelMap map);  // a loaded map; the next sweep is registered to it

  // A monotonic clock in milliseconds for Result::stage_ms; never influences anything else.
  void SetStopwatch(std::function<double()> now_ms) { now_ms_ = std::move(now_ms); }

  // With the last sweep in it.
  const SurfelMap& map() const;
  const Options& options() const { return options_; }

 private:
  Result Start(const Sweep& sweep, const std::vector<Patch>& patches);
  double BridgeTimeTo(const Sweep& sweep);
  RegistrationResult RegisterFromAnywhere(const TimedPatches& patches, const RelativeMotion& hint, bool& searched);
  RegistrationResult ReconsiderStart(const TimedPatches& patches, const RelativeMotion& hint,
                                     const RegistrationResult& from_rest, bool& began_anew);
  bool IsGood(const RegistrationResult& registration) const;
  bool MovedEnough() const;
  bool Insert(const Sweep& sweep, const MotionSegment& motion);
  void AwaitInsertion() const;
  void StartClock();
  void Charge(Stage stage);
  RelativeMotion ToRelativeMotion(const MotionHint& hint) const;
  Result MakeResult(SweepStatus status, const RegistrationResult& registration) const;

  Options options_;
  SurfelMap map_;
  std::optional<int64_t> utime_;         // of the last sweep
  std::optional<Sweep> first_;           // made the map; until the next one tells how it had moved
  StateBelief belief_;                   // at utime_
  std::optional<Pose3> T_map_inserted_;  // where the lidar was when the map took a sweep in last
  std::function<double()> now_ms_;
  double last_ms_ = 0.0;
  std::array<double, kStageNames.size()> stage_ms_{};  // of the sweep in hand
  mutable std::future<void> insertion_;                // under way in a second thread; goes before map_
};

}  // namespace lcmslam::octo3d
