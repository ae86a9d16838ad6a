#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "lidar/deskew.h"
#include "lidar/planar_scan.h"
#include "sdf2d/motion_model.h"
#include "sdf2d/noise_model.h"
#include "sdf2d/options.h"
#include "sdf2d/registration.h"
#include "sdf2d/scan_field.h"
#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// Same numbers as slam_diagnostics_t.
enum class Status : int8_t {
  kInitializing = 0,  // first scans: the pose is the initial one, the map begins
  kTracking = 1,
  kDegenerate = 2,   // tracking, but only the prediction holds some direction
  kRelocalized = 3,  // found again after a jump or a loss
  kLost = 4,         // the pose is the prediction; nothing was mapped
  kSkipped = 5,      // the scan was not used: no returns, or its stamp did not advance
};

enum class Stage { kPrepare, kRegister, kRecover, kExtract, kFuse, kCarve };
inline constexpr std::array kStageNames = {"prepare", "register", "recover", "extract", "fuse", "carve"};
inline constexpr size_t kNumStages = kStageNames.size();

struct Result {
  Status status = Status::kSkipped;
  int64_t utime = 0;                                     // us; the scan's
  Pose2 T_map_body;                                      // at the last beam; the last known where skipped
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x, y, yaw; map axes, about the body's origin
  int num_points = 0;                                    // returns offered to the registration
  int iterations = 0;
  double inlier_ratio = 0.0;                  // of num_points
  double residual_rms_m = 0.0;                // over inliers
  double range_sigma_m = 0.0;                 // noise assumed at 1 m
  std::array<bool, 3> unobservable{};         // the unobservable direction nearest to map x, y, yaw exists
  std::array<double, kNumStages> stage_ms{};  // zeros without a stopwatch
};

// 2D-SDF-SLAM: lidar scans in, poses and a signed distance map out.
// Fossel, Tuyls, Sturm, "2D-SDF-SLAM: A Signed Distance Function based SLAM Frontend for Laser Scanners", IROS 2015.
// Not thread-safe. Same calls, same results, bit for bit.
class Pipeline {
 public:
  // `options` must be valid.
  explicit Pipeline(const Options& options);

  // Any number of beams, any values: whatever is not a finite range within the limits is no return. A stamp that stands
  // still is skipped; one that jumps back by more than the motion model's max_gap_s restarts the clock.
  [[nodiscard]] Result Process(const PlanarScan& scan);

  // Optional. T_odom_body in any fixed frame; call before the scan it should help. Stamps should rise; others are
  // dropped.
  void AddOdometry(int64_t utime, const Pose2& T_odom_body) { motion_.AddOdometry(utime, T_odom_body); }

  // Forgets map, motion and noise.
  void Reset();
  // Continues from there; the map stays.
  void SetPose(const Pose2& T_map_body);
  // Where the lidar sits; before the first scan.
  void SetMounting(const Pose2& T_body_lidar);
  void SetLocalizeOnly(bool localize_only) { options_.localize_only = localize_only; }
  // Continues on a map made earlier; its cell size becomes the pipeline's. The coarse level is derived from it.
  void SetMap(SdfMap map);

  // A monotonic clock in milliseconds for Result::stage_ms; never influences anything else.
  void SetStopwatch(std::function<double()> now_ms) { now_ms_ = std::move(now_ms); }

  const Options& options() const { return options_; }
  const SdfMap& map() const { return map_; }

 private:
  struct Registration {
    AlignResult align;
    Status status = Status::kLost;
  };

  bool Accepts(int64_t utime, std::span<const ScanPoint> points) const;
  void RestartClockIfItJumped(int64_t utime);
  // dt_s: since the last scan; 0 where that tells nothing of the motion.
  Registration Register(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s, Result* result);
  AlignResult AlignAsPredicted(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s) const;
  // These two replace `align` where they fit better.
  void TryCoarseToFine(std::span<const ScanPoint> points, const MotionState& prediction, AlignResult* align) const;
  bool TrySuddenTurn(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s,
                     AlignResult* align) const;  // whether it did
  bool IsSuspicious(const AlignResult& align) const;
  bool IsGood(const AlignResult& align, const MotionState& prediction) const;
  bool IsDoubtful(const AlignResult& align, const MotionState& prediction) const;
  AlignResult Search(std::span<const ScanPoint> points, const MotionState& prediction) const;
  Registration GiveUp(const MotionState& prediction, AlignResult align);
  bool MapIsDue(const Pose2& T_map_body) const;
  void UpdateMap(std::span<const ScanPoint> points, const MotionState& state, Result* result);
  // Adds the time since the last call to a stage.
  void Charge(Stage stage, Result* result);

  Options options_;
  SdfMap map_;
  SdfMap coarse_map_;
  MotionModel motion_;
  NoiseModel noise_;
  ScanField field_;
  Eigen::Vector2d origin_body_;      // the lidar's
  double usual_inlier_ratio_ = 0.0;  // running mean
  int scans_registered_ = 0;
  int scans_lost_ = 0;
  int64_t scans_mapped_ = 0;
  Pose2 T_map_body_mapped_;  // where the last one was
  std::function<double()> now_ms_;
  double last_ms_ = 0.0;
};

}  // namespace lcmslam::sdf2d
