#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace lcmslam {

// What the pipelines of the baselines have in common, in the plane (Pose2, 3) and in space (Pose3, 6).

// Same numbers as slam_diagnostics_t.
enum class TrackingStatus : int8_t {
  kInitializing = 0,  // the scan that began the map; the pose is the guess
  kTracking = 1,
  kLost = 4,     // the map does not fix the pose: it is the guess, and the map was not touched
  kSkipped = 5,  // too few returns: the pose is the guess
};

// What a registration to the map has found.
template <class Pose, int kDof>
struct Registered {
  bool solved = false;  // false: the map does not fix the pose, which is the guess
  Pose T_map_body = {};
  Eigen::Matrix<double, kDof, kDof> covariance = Eigen::Matrix<double, kDof, kDof>::Zero();
  int iterations = 0;
  double inlier_ratio = 0.0;    // of the points
  double residual_rms_m = 0.0;  // over inliers
};

// A scan on its way.
template <class Pose, int kDof>
struct Tracked : Registered<Pose, kDof> {
  TrackingStatus status = TrackingStatus::kSkipped;
  int64_t utime = 0;   // us; the scan's
  int num_points = 0;  // offered to the registration

  // True: the points are to be registered from the guess. False: status says why not.
  bool Begin(size_t points, size_t min_points, bool has_map, bool localize_only, const Pose& T_map_body_guess) {
    num_points = static_cast<int>(points);
    this->T_map_body = T_map_body_guess;
    if (points < min_points) {
      status = TrackingStatus::kSkipped;
    } else if (has_map) {
      status = TrackingStatus::kTracking;
    } else {
      status = localize_only ? TrackingStatus::kLost : TrackingStatus::kInitializing;
    }
    return status == TrackingStatus::kTracking;
  }

  void Take(const Registered<Pose, kDof>& registered) {
    static_cast<Registered<Pose, kDof>&>(*this) = registered;
    status = registered.solved ? TrackingStatus::kTracking : TrackingStatus::kLost;
  }

  // Whether the scan may be written into the map.
  bool IsPlaced() const { return status == TrackingStatus::kInitializing || status == TrackingStatus::kTracking; }
};

}  // namespace lcmslam
