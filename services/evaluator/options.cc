#include "evaluator/options.h"

#include <cmath>

#include <fmt/format.h>

#include "bus/errors.h"
#include "common/config.h"
#include "evaluator/evaluator.pb.h"

namespace lcmslam {
namespace {

void BindSeconds(ConfigBinder& bind, const char* field, int64_t& option_us) {
  double option_s = static_cast<double>(option_us) * 1e-6;
  bind(field, option_s);
  if (std::abs(option_s) > 1e9) throw CommandError(ExitCode::kUsage, fmt::format("{}: out of range", field));
  option_us = std::llround(option_s * 1e6);
}

void BindAlign(config::Evaluator& config, EvaluationOptions& options) {
  using Config = config::Evaluator;
  if (!config.has_align()) config.set_align(Config::AUTO);
  options.calibrate = config.align() == Config::CALIBRATE;
  const bool is_automatic = options.calibrate || config.align() == Config::AUTO;
  if (!is_automatic) options.alignment = static_cast<AlignmentKind>(config.align() - Config::NONE);
}

void BindSteps(google::protobuf::RepeatedField<double>& field, std::vector<double>& steps) {
  if (!field.empty()) steps.assign(field.begin(), field.end());
  field.Assign(steps.begin(), steps.end());
}

// A demand that is not set stays unset in the configuration.
void BindThreshold(bool is_set, double value, const char* name, std::optional<double>& threshold) {
  if (!is_set) return;
  if (!(value >= 0.0) || std::isinf(value)) {
    throw CommandError(ExitCode::kUsage, fmt::format("thresholds.{}: must be finite and not negative", name));
  }
  threshold = value;
}

void BindThresholds(const config::Evaluator::Thresholds& config, EvaluatorThresholds& options) {
  BindThreshold(config.has_max_mean_m(), config.max_mean_m(), "max_mean_m", options.max_mean_m);
  BindThreshold(config.has_max_rmse_m(), config.max_rmse_m(), "max_rmse_m", options.max_rmse_m);
  BindThreshold(config.has_max_p95_m(), config.max_p95_m(), "max_p95_m", options.max_p95_m);
  BindThreshold(config.has_max_error_m(), config.max_error_m(), "max_error_m", options.max_error_m);
  BindThreshold(config.has_max_mean_rotation_rad(), config.max_mean_rotation_rad(), "max_mean_rotation_rad",
                options.max_mean_rotation_rad);
  BindThreshold(config.has_min_coverage(), config.min_coverage(), "min_coverage", options.min_coverage);
}

}  // namespace

bool EvaluatorThresholds::Any() const {
  return max_mean_m || max_rmse_m || max_p95_m || max_error_m || max_mean_rotation_rad || min_coverage;
}

std::string EvaluatorOptions::Validate() const {
  if (estimate_channel.empty()) return "estimate_channel: must not be empty";
  if (reference_channel.empty()) return "reference_channel: must not be empty";
  if (evaluation_channel.empty()) return "evaluation_channel: must not be empty";
  if (thresholds.min_coverage > 1.0) return "thresholds.min_coverage: must be in 0..1";
  return evaluation.Validate();
}

EvaluatorOptions CompleteOptions(config::Evaluator& config) {
  EvaluatorOptions options;
  EvaluationOptions& evaluation = options.evaluation;
  ConfigBinder bind(config);
  bind("estimate_channel", options.estimate_channel)("reference_channel", options.reference_channel);
  bind("evaluation_channel", options.evaluation_channel);
  BindAlign(config, evaluation);
  BindSeconds(bind, "max_gap_s", evaluation.association.max_gap_us);
  BindSeconds(bind, "time_offset_s", evaluation.association.time_offset_us);
  bind("min_spread_m", evaluation.align.min_spread_m);
  BindSteps(*config.mutable_rpe_step_s(), evaluation.rpe_steps_s);
  BindSteps(*config.mutable_rpe_step_m(), evaluation.rpe_steps_m);
  if (config.thresholds().ByteSizeLong() == 0) config.clear_thresholds();
  BindThresholds(config.thresholds(), options.thresholds);
  CalibrationOptions& calibration = evaluation.calibration;
  bind.Sub("calibration")("max_time_offset_s", calibration.max_time_offset_s)("huber_sigmas", calibration.huber_sigmas)(
      "max_time_offset_sd_s", calibration.max_time_offset_sd_s)("max_lever_arm_sd_m", calibration.max_lever_arm_sd_m)(
      "max_rotation_sd_rad", calibration.max_rotation_sd_rad);
  RequireValid(options.Validate());
  return options;
}

}  // namespace lcmslam
