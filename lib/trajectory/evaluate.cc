#include "trajectory/evaluate.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

namespace lcmslam {
namespace {

ErrorSummary SummarizeErrors(PoseErrors errors) {
  return {Summarize(std::move(errors.translation_m)), Summarize(std::move(errors.rotation_rad))};
}

void MeasureWholeRun(std::span<const double> path_m, Evaluation& result) {
  const std::span<const PosePair> pairs = result.association.pairs;
  result.absolute_errors = AbsoluteErrors(pairs);
  result.absolute = SummarizeErrors(result.absolute_errors);
  KittiErrors kitti = KittiSegmentErrors(pairs, path_m);
  result.kitti_translation_ratio = Summarize(std::move(kitti.translation_ratio));
  result.kitti_rotation_rad_per_m = Summarize(std::move(kitti.rotation_rad_per_m));
  result.drift = DriftPerMetre(pairs, path_m);
  result.duration_s = static_cast<double>(pairs.back().utime - pairs.front().utime) * 1e-6;
}

// errors_of(step): the relative errors over one step. In a thread of its own.
template <typename ErrorsOf>
std::future<std::vector<RelativeErrorSummary>> MeasureSteps(const std::vector<double>& steps, ErrorsOf errors_of) {
  return std::async(std::launch::async, [&steps, errors_of] {
    std::vector<RelativeErrorSummary> summaries;
    for (const double step : steps) summaries.push_back({step, SummarizeErrors(errors_of(step))});
    return summaries;
  });
}

// The three parts are independent and take about as long, so each has a thread.
void Measure(const EvaluationOptions& options, Evaluation& result) {
  const std::span<const PosePair> pairs = result.association.pairs;
  const std::vector<double> path_m = PathLengths(pairs);
  auto over_time =
      MeasureSteps(options.rpe_steps_s, [pairs](double step_s) { return RelativeErrorsOverTime(pairs, step_s); });
  auto over_distance = MeasureSteps(options.rpe_steps_m, [pairs, &path_m](double step_m) {
    return RelativeErrorsOverDistance(pairs, path_m, step_m);
  });
  MeasureWholeRun(path_m, result);
  result.relative_over_time = over_time.get();
  result.relative_over_distance = over_distance.get();
  result.status = EvaluationStatus::kOk;
}

Evaluation EvaluateCalibrated(std::span<const StampedPose> estimate, std::span<const StampedPose> reference,
                              AlignmentKind kind, const EvaluationOptions& options) {
  Evaluation result;
  CalibrationOptions calibration_options = options.calibration;
  calibration_options.alignment = kind;
  calibration_options.max_gap_us = options.association.max_gap_us;
  result.calibration = Calibrate(estimate, reference, calibration_options);
  const Calibration& calibration = *result.calibration;
  if (calibration.status != CalibrationStatus::kOk) {
    const bool is_empty = Associate(estimate, reference, options.association).pairs.empty();
    result.status = is_empty ? EvaluationStatus::kNothingMatched : EvaluationStatus::kCalibrationFailed;
    return result;
  }
  AssociationOptions association = options.association;
  association.time_offset_us = std::llround(calibration.time_offset_s * 1e6);
  result.association = Associate(estimate, reference, association);
  auto& pairs = result.association.pairs;
  if (pairs.empty()) return result;
  for (PosePair& pair : pairs) pair.estimate = pair.estimate * calibration.T_body_marker;
  Apply(calibration.T_world_map, pairs);
  result.alignment = {.status = AlignmentStatus::kOk, .kind = kind, .T_world_map = calibration.T_world_map};
  Measure(options, result);
  return result;
}

}  // namespace

std::string EvaluationOptions::Validate() const {
  if (auto error = association.Validate(); !error.empty()) return "association." + error;
  if (auto error = align.Validate(); !error.empty()) return "align." + error;
  if (auto error = calibration.Validate(); !error.empty()) return "calibration." + error;
  const bool is_joint = !alignment || alignment == AlignmentKind::kSe2 || alignment == AlignmentKind::kSe3;
  if (calibrate && !is_joint) return "alignment: calibrate goes with se2 and se3 only";
  const auto is_step = [](double step) { return step > 0.0; };
  if (!std::ranges::all_of(rpe_steps_s, is_step)) return "rpe_steps_s: must be positive";
  if (!std::ranges::all_of(rpe_steps_m, is_step)) return "rpe_steps_m: must be positive";
  return "";
}

AlignmentKind ChooseAlignment(const EvaluationOptions& options, bool estimate_is_planar) {
  return options.alignment.value_or(estimate_is_planar ? AlignmentKind::kSe2 : AlignmentKind::kSe3);
}

Evaluation EvaluatePairs(Association association, AlignmentKind kind, const EvaluationOptions& options) {
  Evaluation result;
  result.association = std::move(association);
  auto& pairs = result.association.pairs;
  if (pairs.empty()) return result;
  if (kind == AlignmentKind::kSe2) FlattenToPlane(pairs);
  result.alignment = Align(pairs, kind, options.align);
  Apply(result.alignment.T_world_map, pairs);
  Measure(options, result);
  return result;
}

Evaluation Evaluate(Trajectory estimate, Trajectory reference, const EvaluationOptions& options) {
  const AlignmentKind kind = ChooseAlignment(options, IsPlanar(estimate));
  if (options.calibrate) return EvaluateCalibrated(estimate, reference, kind, options);
  Association association = Associate(estimate, reference, options.association);
  estimate = Trajectory();  // with many millions of poses there is no room for them and the errors
  reference = Trajectory();
  return EvaluatePairs(std::move(association), kind, options);
}

}  // namespace lcmslam
