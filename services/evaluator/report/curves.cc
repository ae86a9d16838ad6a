#include "evaluator/report/curves.h"

#include <cmath>

#include "bus/errors.h"
#include "evaluator/result.h"
#include "trajectory/alignment.h"
#include "trajectory/pose_errors.h"
#include "trajectory/read.h"

namespace lcmslam::report {
namespace {

Trajectory ReadOrThrow(const std::filesystem::path& path) {
  TrajectoryFile file = ReadTrajectory(path);
  if (!file.error.empty()) throw CommandError(ExitCode::kBadInput, file.error);
  return std::move(file.trajectory);
}

// The estimate where the metrics' alignment and calibration put it.
Trajectory Aligned(const Trajectory& estimate, const result::Evaluation& metrics) {
  const Pose3 T_world_map = metrics.has_alignment() ? ToPose(metrics.alignment().t_world_map()) : Pose3{};
  const Pose3 T_body_marker = metrics.has_calibration() ? ToPose(metrics.calibration().t_body_marker()) : Pose3{};
  Trajectory aligned = estimate;
  for (StampedPose& pose : aligned) pose.pose = T_world_map * pose.pose * T_body_marker;
  return aligned;
}

SystemCurve MakeCurve(const Run& run, const Trajectory& reference) {
  const result::Evaluation& metrics = run.metrics;
  SystemCurve curve;
  curve.trajectory = Aligned(ReadOrThrow(run.trajectory), metrics);
  if (reference.empty()) return curve;
  AssociationOptions options;
  if (metrics.has_association()) {
    options.max_gap_us = std::llround(metrics.association().max_gap_s() * 1e6);
    options.time_offset_us = std::llround(metrics.association().time_offset_s() * 1e6);
  }
  std::vector<PosePair> pairs = Associate(curve.trajectory, reference, options).pairs;
  const bool is_flat = metrics.alignment().kind() == Name(AlignmentKind::kSe2) && !metrics.has_calibration();
  if (is_flat) FlattenToPlane(pairs);
  curve.error_m = AbsoluteErrors(pairs).translation_m;
  for (const PosePair& pair : pairs) {
    curve.time_s.push_back(static_cast<double>(pair.utime - reference.front().utime) * 1e-6);
  }
  return curve;
}

}  // namespace

EpisodeCurves LoadCurves(const Episode& episode) {
  EpisodeCurves curves;
  if (!episode.reference.empty()) curves.reference = ReadOrThrow(episode.reference);
  for (const auto& [system, run] : episode.runs) {
    const bool is_there = run.has_metrics && !run.trajectory.empty();
    if (is_there && ErrorOf(run).translation_m().has_mean()) curves.systems[system] = MakeCurve(run, curves.reference);
  }
  return curves;
}

}  // namespace lcmslam::report
