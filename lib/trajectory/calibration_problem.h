#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trajectory/calibration.h"
#include "trajectory/local_motion.h"

namespace lcmslam {

// One pose of the estimate and the reference around the moment that belongs to it.
struct CalibrationSample {
  Pose3 T_map_body;
  LocalMotion reference;  // T_world_marker around estimate stamp + time offset
};

// The least-squares problem inside Calibrate(). Its unknowns are small motions from a start:
//   time offset (s) | lever arm (m) | marker rotation (rotation vector, body frame) | T_world_map
class CalibrationProblem {
 public:
  static constexpr int kCalibrated = 7;  // time offset, lever arm, marker rotation, in this order
  using Deviations = Eigen::Matrix<double, kCalibrated, 1>;

  // Starts from no lever arm and from the mean difference in orientation of the pairs.
  CalibrationProblem(std::span<const PosePair> pairs, const Pose3& T_world_map_start,
                     const CalibrationOptions& options);

  void set_time_offset_s(double offset_s) { unknowns_.time_offset_s = offset_s; }
  // From now on these parameters (0 to 6) keep their start: 0 for time offset and lever arm.
  void HoldAtStart(std::span<const int> parameters);

  // Moves the unknowns to the optimum for samples that were fitted around `fitted_offset_s`, then measures the noise
  // that the next call weighs by. False when there are too few samples or Ceres fails.
  [[nodiscard]] bool Solve(std::span<const CalibrationSample> samples, double fitted_offset_s);

  // Of the last Solve, which held nothing; infinite in directions that the samples tell nothing of.
  Deviations StandardDeviations() const;

  double time_offset_s() const { return unknowns_.time_offset_s; }
  Pose3 T_body_marker() const;
  Pose3 T_world_map() const;
  int64_t samples() const { return samples_; }
  double position_sigma_m() const { return position_sigma_m_; }
  double orientation_sigma_rad() const { return orientation_sigma_rad_; }

 private:
  // Where the unknowns start from.
  struct Start {
    Pose3 T_world_map;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of the reference; T_world_map is turned about it
    Eigen::Quaterniond marker = Eigen::Quaterniond::Identity();
  };
  struct Unknowns {
    double time_offset_s = 0.0;
    Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
    Eigen::Vector3d marker_rotation = Eigen::Vector3d::Zero();
    Eigen::Vector3d world_translation = Eigen::Vector3d::Zero();
    Eigen::Vector3d world_rotation = Eigen::Vector3d::Zero();
  };
  struct Held {  // components that keep their start
    bool time_offset = false;
    std::vector<int> lever_arm, marker_rotation, world_translation, world_rotation;
  };
  struct Residuals;

  Residuals AddResiduals(std::span<const CalibrationSample> samples, double fitted_offset_s);

  double huber_sigmas_;
  Start start_;
  Unknowns unknowns_;
  Held held_;

  int64_t samples_ = 0;
  double position_sigma_m_ = 0.02;
  double orientation_sigma_rad_ = 0.02;
  double last_time_step_s_ = 0.0;
  Eigen::MatrixXd information_;  // of all unknowns that are not held; the calibrated ones first
};

}  // namespace lcmslam
