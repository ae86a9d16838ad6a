#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>

#include "bus/service.h"
#include "evaluator/options.h"
#include "evaluator/pair_file.h"
#include "trajectory/online_evaluation.h"

namespace lcmslam {

// Judges every estimate on the bus by the reference, while both come in: evaluation_t once a second for each estimate.
class EvaluatorService : public Service {
 public:
  static constexpr const char* kName = "evaluator";

  // What is known of one estimate when the input has ended.
  struct Outcome {
    std::string estimate_channel, reference_channel;
    int64_t estimate_poses = 0, reference_poses = 0;
    Evaluation evaluation;
    std::string text;
  };
  using Report = std::function<void(const Outcome&)>;

  // `report` is called for each estimate at the end.
  EvaluatorService(const EvaluatorOptions& options, ServiceContext& context, Report report);
  void Finish() override;

 private:
  struct Estimate {
    explicit Estimate(const EvaluationOptions& options) : online(options) {}

    OnlineEvaluation online;
    int64_t poses = 0;
    PairFile pairs;  // of segment
    int segment = 1;
  };

  Handled OnReference(const Event& event);
  Handled OnEstimate(const Event& event);
  void PublishErrors();
  void StorePairs(Estimate& estimate);

  EvaluatorOptions options_;
  ServiceContext& context_;
  Report report_;
  std::map<std::string, Estimate> estimates_;  // by channel
  std::string reference_channel_;              // the first that had a pose
  std::deque<StampedPose> recent_reference_;   // for estimates that begin later
  int64_t reference_poses_ = 0;
};

}  // namespace lcmslam
