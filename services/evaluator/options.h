#pragma once

#include <optional>
#include <string>

#include "trajectory/evaluate.h"

namespace lcmslam {

namespace config {
class Evaluator;
}

// What a run must reach.
struct EvaluatorThresholds {
  std::optional<double> max_mean_m, max_rmse_m, max_p95_m, max_error_m, max_mean_rotation_rad, min_coverage;
  bool Any() const;
};

struct EvaluatorOptions {
  std::string estimate_channel = ".*_POSE";  // regular expressions
  std::string reference_channel = "GROUND_TRUTH|TRUE_POSE";
  std::string evaluation_channel = "EVALUATION";
  EvaluationOptions evaluation;
  EvaluatorThresholds thresholds;

  std::string Validate() const;  // "" or "field: reason"
};

// Options from the configuration, which is filled up with the defaults. Throws CommandError (kUsage).
EvaluatorOptions CompleteOptions(config::Evaluator& config);

}  // namespace lcmslam
