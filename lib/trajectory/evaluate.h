#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trajectory/alignment.h"
#include "trajectory/association.h"
#include "trajectory/calibration.h"
#include "trajectory/pose_errors.h"
#include "trajectory/summary.h"

namespace lcmslam {

struct EvaluationOptions {
  AssociationOptions association = {};
  std::optional<AlignmentKind> alignment = {};  // none: se2 for planar estimates, se3 for others
  bool calibrate = false;  // solve for time offset (in place of association's) and marker too; with se2 or se3 only
  AlignmentOptions align = {};
  CalibrationOptions calibration = {};  // its alignment and gap are taken from above
  std::vector<double> rpe_steps_s = {0.1, 1.0, 5.0};
  std::vector<double> rpe_steps_m = {0.5, 1.0, 2.0, 5.0};
  std::string Validate() const;  // "" or "field: reason"
};

struct ErrorSummary {
  Summary translation_m;
  Summary rotation_rad;
};

struct RelativeErrorSummary {
  double step = 0.0;  // s or m
  ErrorSummary error;
};

enum class EvaluationStatus { kOk, kNothingMatched, kCalibrationFailed };

struct Evaluation {
  EvaluationStatus status = EvaluationStatus::kNothingMatched;
  Association association;  // pairs are aligned: both sides in the world frame, in the plane for se2
  Alignment alignment;
  std::optional<Calibration> calibration;  // the errors are those of the marker, then

  PoseErrors absolute_errors;  // one entry a pair
  ErrorSummary absolute;
  std::vector<RelativeErrorSummary> relative_over_time;  // in the order of the options' steps
  std::vector<RelativeErrorSummary> relative_over_distance;
  Summary kitti_translation_ratio;  // count 0 on runs below 100 m
  Summary kitti_rotation_rad_per_m;
  Drift drift;
  double duration_s = 0.0;  // from the first pair to the last
};

// The alignment to use: that of the options, else by whether the estimate is planar.
[[nodiscard]] AlignmentKind ChooseAlignment(const EvaluationOptions& options, bool estimate_is_planar);

// Aligns and measures. For se2 the pairs are flattened first.
[[nodiscard]] Evaluation EvaluatePairs(Association association, AlignmentKind kind, const EvaluationOptions& options);

// Associates, aligns and measures (algorithms as named in the headers above). Poses are finite, stamps strictly
// increasing. Pure; linear in the number of poses. Trajectories that are moved in are freed once they are associated.
[[nodiscard]] Evaluation Evaluate(Trajectory estimate, Trajectory reference, const EvaluationOptions& options = {});

}  // namespace lcmslam
