#include "evaluator/evaluator_service.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <lcmslam/evaluation_t.hpp>

#include "bus/errors.h"
#include "bus/messages.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr size_t kRecentPoses = 1000;

std::optional<StampedPose> DecodeReasonablePose(const Event& event) {
  const auto pose = DecodePose(event.data);
  return pose && IsReasonableUtime(pose->utime) ? pose : std::nullopt;
}

// Numbers that nothing was measured for are 0, and matched is 0 then.
double OrZero(double value) { return std::isfinite(value) ? value : 0.0; }

evaluation_t ToMessage(const OnlineEvaluation& online) {
  const OnlineEvaluation::Result result = online.ErrorSoFar();
  evaluation_t message{};
  message.utime = result.utime;
  message.matched = result.matched;
  message.unmatched = result.unmatched;
  message.ate_mean = OrZero(result.error.translation_m.mean);
  message.ate_rmse = OrZero(result.error.translation_m.rmse);
  message.ate_max = OrZero(result.error.translation_m.max);
  message.rotation_mean = OrZero(result.error.rotation_rad.mean);
  message.latest_error = result.latest_error_m;
  message.coverage = result.coverage;
  const Pose3& T = result.alignment.T_world_map;
  std::copy_n(T.translation.data(), 3, message.alignment_pos);
  message.alignment_quat[0] = T.rotation.w();
  std::copy_n(T.rotation.vec().data(), 3, message.alignment_quat + 1);
  message.alignment = Name(online.alignment_kind());
  message.text = result.text;
  return message;
}

}  // namespace

EvaluatorService::EvaluatorService(const EvaluatorOptions& options, ServiceContext& context, Report report)
    : options_(options), context_(context), report_(std::move(report)) {
  context.Subscribe(options_.reference_channel, [this](const Event& event) { return OnReference(event); });
  context.Subscribe(options_.estimate_channel, [this](const Event& event) { return OnEstimate(event); });
  context.EverySecond([this](int64_t) { PublishErrors(); });
}

Handled EvaluatorService::OnReference(const Event& event) {
  const auto pose = DecodeReasonablePose(event);
  if (!pose) return Handled::kRefused;
  if (reference_channel_.empty()) reference_channel_ = event.channel;
  if (event.channel != reference_channel_) return Handled::kIgnored;
  context_.health().NoteInput(event.channel, pose->utime);
  ++reference_poses_;
  recent_reference_.push_back(*pose);
  if (recent_reference_.size() > kRecentPoses) recent_reference_.pop_front();
  for (auto& [channel, estimate] : estimates_) {
    estimate.online.AddReference(*pose);
    StorePairs(estimate);
  }
  return Handled::kAccepted;
}

Handled EvaluatorService::OnEstimate(const Event& event) {
  if (event.channel == reference_channel_) return Handled::kIgnored;
  const auto pose = DecodeReasonablePose(event);
  if (!pose) return Handled::kRefused;
  context_.health().NoteInput(event.channel, pose->utime);
  auto [entry, is_new] = estimates_.try_emplace(event.channel, options_.evaluation);
  Estimate& estimate = entry->second;
  if (is_new) {
    for (const StampedPose& reference : recent_reference_) estimate.online.AddReference(reference);
  }
  ++estimate.poses;
  estimate.online.AddEstimate(*pose);
  StorePairs(estimate);
  return Handled::kAccepted;
}

void EvaluatorService::StorePairs(Estimate& estimate) {
  if (estimate.segment != estimate.online.segment()) {
    estimate.segment = estimate.online.segment();
    estimate.pairs.Clear();
  }
  estimate.pairs.Add(estimate.online.TakePairs());
}

void EvaluatorService::PublishErrors() {
  std::string text;
  for (const auto& [channel, estimate] : estimates_) {
    evaluation_t message = ToMessage(estimate.online);
    message.estimate_channel = channel;
    message.reference_channel = reference_channel_;
    context_.Publish(options_.evaluation_channel, message);
    text += fmt::format("{}{} {:.4f} m", text.empty() ? "" : ", ", channel, message.ate_mean);
  }
  context_.health().SetText(text.empty() ? "no estimate yet" : "mean error " + text);
}

void EvaluatorService::Finish() {
  PublishErrors();
  for (auto& [channel, estimate] : estimates_) {
    std::optional<std::vector<PosePair>> pairs = estimate.pairs.ReadAll();
    if (!pairs) {
      throw CommandError(ExitCode::kRuntime, channel + ": the temporary file for its poses could not be written");
    }
    const OnlineEvaluation& online = estimate.online;
    Evaluation evaluation =
        EvaluatePairs(online.FinalAssociation(std::move(*pairs)), online.alignment_kind(), options_.evaluation);
    report_({channel, reference_channel_, estimate.poses, reference_poses_, std::move(evaluation), online.Describe()});
  }
}

}  // namespace lcmslam
