#include "evaluator/result.h"

#include <cmath>

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include "bus/errors.h"
#include "evaluator/files.h"
#include "geometry/angles.h"

namespace lcmslam {
namespace {

int32_t Count(int64_t count) { return static_cast<int32_t>(std::min<int64_t>(count, INT32_MAX)); }

result::PoseError ToMessage(const ErrorSummary& error) {
  result::PoseError message;
  *message.mutable_translation_m() = ToMessage(error.translation_m);
  *message.mutable_rotation_rad() = ToMessage(error.rotation_rad);
  *message.mutable_rotation_deg() = ToMessage(error.rotation_rad, RadToDeg(1.0));
  return message;
}

result::Evaluation::Pose ToMessage(const Pose3& pose) {
  result::Evaluation::Pose message;
  message.set_x_m(pose.translation.x());
  message.set_y_m(pose.translation.y());
  message.set_z_m(pose.translation.z());
  message.set_qw(pose.rotation.w());
  message.set_qx(pose.rotation.x());
  message.set_qy(pose.rotation.y());
  message.set_qz(pose.rotation.z());
  return message;
}

result::Evaluation::Association ToMessage(const Evaluation& evaluation, const AssociationOptions& options) {
  const Association& association = evaluation.association;
  const double calibrated_s = evaluation.calibration ? evaluation.calibration->time_offset_s : 0.0;
  result::Evaluation::Association message;
  message.set_max_gap_s(static_cast<double>(options.max_gap_us) * 1e-6);
  message.set_time_offset_s(evaluation.calibration ? calibrated_s : static_cast<double>(options.time_offset_us) * 1e-6);
  message.set_matched(Count(static_cast<int64_t>(association.pairs.size())));
  message.set_before(Count(association.before));
  message.set_after(Count(association.after));
  message.set_in_gap(Count(association.in_gap));
  message.set_coverage(association.coverage());
  message.set_duration_s(evaluation.duration_s);
  message.set_path_length_m(evaluation.drift.path_length_m);
  return message;
}

result::Evaluation::Calibration ToMessage(const Calibration& calibration) {
  result::Evaluation::Calibration message;
  message.set_time_offset_s(calibration.time_offset_s);
  if (std::isfinite(calibration.time_offset_sd_s)) message.set_time_offset_sd_s(calibration.time_offset_sd_s);
  *message.mutable_t_body_marker() = ToMessage(calibration.T_body_marker);
  if (calibration.lever_arm_sd_m.allFinite()) {
    for (const double sd_m : calibration.lever_arm_sd_m) message.add_lever_arm_sd_m(sd_m);
  }
  if (calibration.rotation_sd_rad.allFinite()) {
    for (const double sd_rad : calibration.rotation_sd_rad) message.add_rotation_sd_rad(sd_rad);
  }
  message.set_position_sigma_m(calibration.position_sigma_m);
  message.set_orientation_sigma_rad(calibration.orientation_sigma_rad);
  for (const std::string& parameter : calibration.unexcited) message.add_unexcited(parameter);
  return message;
}

void AddRelative(const RelativeErrorSummary& relative, bool over_time, result::Evaluation& message) {
  result::Evaluation::RelativeError& error = *message.add_relative();
  over_time ? error.set_step_s(relative.step) : error.set_step_m(relative.step);
  *error.mutable_error() = ToMessage(relative.error);
}

Summary SummarizeSquares(std::vector<double> values, double unit = 1.0) {
  for (double& value : values) value = unit * value * unit * value;
  return Summarize(values);
}

bool AddThreshold(const char* name, std::optional<double> limit, double value, bool at_most,
                  result::Evaluation& message) {
  if (!limit) return true;
  const bool met = at_most ? value <= *limit : value >= *limit;  // false for NaN
  result::Evaluation::Threshold& threshold = *message.add_thresholds();
  threshold.set_name(name);
  threshold.set_limit(*limit);
  if (std::isfinite(value)) threshold.set_value(value);
  threshold.set_met(met);
  return met;
}

}  // namespace

result::Summary ToMessage(const Summary& summary, double unit) {
  result::Summary message;
  message.set_count(Count(summary.count));
  if (summary.count == 0) return message;
  message.set_mean(unit * summary.mean);
  message.set_rmse(unit * summary.rmse);
  message.set_median(unit * summary.median);
  message.set_sd(unit * summary.sd);
  message.set_p95(unit * summary.p95);
  message.set_p99(unit * summary.p99);
  message.set_min(unit * summary.min);
  message.set_max(unit * summary.max);
  return message;
}

Pose3 ToPose(const result::Evaluation::Pose& p) {
  return {{p.x_m(), p.y_m(), p.z_m()}, Eigen::Quaterniond(p.qw(), p.qx(), p.qy(), p.qz()).normalized()};
}

void AddSource(const PoseSource& source, result::Evaluation::Source& message) {
  message.set_name(source.name);
  message.set_poses(Count(static_cast<int64_t>(source.trajectory.size())));
  message.set_refused(Count(source.refused));
  message.set_out_of_order(Count(source.out_of_order));
}

void AddEvaluation(const Evaluation& evaluation, const EvaluationOptions& options, result::Evaluation& message) {
  *message.mutable_association() = ToMessage(evaluation, options.association);
  message.mutable_alignment()->set_kind(std::string(Name(evaluation.alignment.kind)));
  *message.mutable_alignment()->mutable_t_world_map() = ToMessage(evaluation.alignment.T_world_map);
  message.mutable_alignment()->set_unobservable(DescribeUnobservable(evaluation.alignment));
  if (evaluation.calibration) *message.mutable_calibration() = ToMessage(*evaluation.calibration);
  *message.mutable_absolute() = ToMessage(evaluation.absolute);
  for (const auto& relative : evaluation.relative_over_time) AddRelative(relative, true, message);
  for (const auto& relative : evaluation.relative_over_distance) AddRelative(relative, false, message);
  if (evaluation.kitti_translation_ratio.count > 0) {
    *message.mutable_kitti()->mutable_translation_percent() = ToMessage(evaluation.kitti_translation_ratio, 100.0);
    *message.mutable_kitti()->mutable_rotation_deg_per_m() =
        ToMessage(evaluation.kitti_rotation_rad_per_m, RadToDeg(1.0));
  }
  if (std::isfinite(evaluation.drift.translation_m_per_m)) {
    message.mutable_drift()->set_translation_m_per_m(evaluation.drift.translation_m_per_m);
    message.mutable_drift()->set_rotation_rad_per_m(evaluation.drift.rotation_rad_per_m);
  }
}

void AddRelations(const RelationErrors& relations, result::Evaluation& message) {
  const PoseErrors& errors = relations.errors;
  result::Evaluation::Relations& m = *message.mutable_relations();
  m.set_matched(Count(static_cast<int64_t>(errors.translation_m.size())));
  m.set_unmatched(Count(relations.unmatched));
  *m.mutable_error() = ToMessage(ErrorSummary{Summarize(errors.translation_m), Summarize(errors.rotation_rad)});
  *m.mutable_squared_translation_m2() = ToMessage(SummarizeSquares(errors.translation_m));
  *m.mutable_squared_rotation_rad2() = ToMessage(SummarizeSquares(errors.rotation_rad));
  *m.mutable_squared_rotation_deg2() = ToMessage(SummarizeSquares(errors.rotation_rad, RadToDeg(1.0)));
}

bool AddThresholds(const EvaluatorThresholds& thresholds, result::Evaluation& message) {
  const bool has_absolute = message.has_absolute();
  const result::PoseError& error = has_absolute ? message.absolute() : message.relations().error();
  const auto& relations = message.relations();
  const double of_relations =
      static_cast<double>(relations.matched()) / static_cast<double>(relations.matched() + relations.unmatched());
  const double coverage = has_absolute ? message.association().coverage() : of_relations;
  const auto& t = error.translation_m();
  const double known = t.has_mean() ? 1.0 : std::nan("");  // absent fields read as 0
  bool met = AddThreshold("max_mean_m", thresholds.max_mean_m, known * t.mean(), true, message);
  met &= AddThreshold("max_rmse_m", thresholds.max_rmse_m, known * t.rmse(), true, message);
  met &= AddThreshold("max_p95_m", thresholds.max_p95_m, known * t.p95(), true, message);
  met &= AddThreshold("max_error_m", thresholds.max_error_m, known * t.max(), true, message);
  met &= AddThreshold("max_mean_rotation_rad", thresholds.max_mean_rotation_rad, known * error.rotation_rad().mean(),
                      true, message);
  met &= AddThreshold("min_coverage", thresholds.min_coverage, coverage, false, message);
  return met;
}

std::string ToJson(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.preserve_proto_field_names = true;
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(message, &json, options);
  return status.ok() ? json : "";
}

void ReadJson(const std::filesystem::path& path, google::protobuf::Message& message) {
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;
  if (!google::protobuf::util::JsonStringToMessage(ReadFile(path), &message, options).ok()) {
    throw CommandError(ExitCode::kBadInput, fmt::format("{}: not the result of an evaluation", path.string()));
  }
}

}  // namespace lcmslam
