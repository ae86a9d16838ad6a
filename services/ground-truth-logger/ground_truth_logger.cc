#include "ground-truth-logger/ground_truth_logger.h"

#include <fmt/format.h>

#include "bus/messages.h"
#include "common/config.h"
#include "geometry/utime.h"
#include "ground-truth-logger/ground_truth_logger.pb.h"
#include "trajectory/write.h"

namespace lcmslam {

std::string GroundTruthLoggerOptions::Validate() const {
  if (channel.empty()) return "channel: must not be empty";
  if (!(max_gap_s > 0.0)) return "max_gap_s: must be positive";
  if (prefix.empty()) return "prefix: must not be empty";
  return "";
}

GroundTruthSegment::GroundTruthSegment(const std::filesystem::path& stem)
    : tum_path_(stem.string() + "_tum.txt"), tum_(tum_path_), log_(stem.string() + ".lcm") {
  if (!tum_) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", tum_path_.string()));
}

void GroundTruthSegment::Write(const StampedPose& pose, const Event& event) {
  tum_ << FormatTum(pose);
  log_.Write(event.utime, event.channel, event.data);
  last_utime_ = pose.utime;
}

void GroundTruthSegment::Flush() {
  log_.Flush();
  if (!tum_.flush()) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", tum_path_.string()));
}

GroundTruthLoggerOptions GroundTruthLogger::Complete(Config& config) {
  Options options;
  ConfigBinder bind(config);
  bind("channel", options.channel)("max_gap_s", options.max_gap_s)("prefix", options.prefix);
  RequireValid(options.Validate());
  return options;
}

GroundTruthLogger::GroundTruthLogger(const Options& options, const Config& /*config*/, ServiceContext& context)
    : options_(options), context_(context) {
  if (context.options().out.empty()) throw CommandError(ExitCode::kUsage, "--out: a folder for the files is required");
  context.Subscribe(options_.channel, [this](const Event& event) { return OnPose(event); });
  context.EverySecond([this](int64_t) { Flush(); });
}

Handled GroundTruthLogger::OnPose(const Event& event) {
  const std::optional<StampedPose> pose = DecodePose(event.data);
  if (!pose) return Handled::kRefused;
  context_.health().NoteInput(event.channel, pose->utime);
  if (segment_ && pose->utime == segment_->last_utime()) {
    ++repeated_;
  } else {
    if (!ContinuesSegment(*pose)) StartSegment();
    segment_->Write(*pose, event);
    ++poses_;
  }
  return Handled::kAccepted;
}

bool GroundTruthLogger::ContinuesSegment(const StampedPose& pose) const {
  if (!segment_) return false;
  const int64_t step_us = UtimeDifference(pose.utime, segment_->last_utime());
  return step_us > 0 && static_cast<double>(step_us) <= options_.max_gap_s * 1e6;
}

void GroundTruthLogger::StartSegment() {
  Flush();
  segment_.emplace(context_.options().out / fmt::format("{}_{:03}", options_.prefix, segments_++));
}

void GroundTruthLogger::Flush() {
  if (segment_) segment_->Flush();
  std::string text = fmt::format("{} poses in {} segment{}", poses_, segments_, segments_ == 1 ? "" : "s");
  if (repeated_ > 0) text += fmt::format(", {} repeated stamps left out", repeated_);
  context_.health().SetText(std::move(text));
}

void GroundTruthLogger::Finish() { Flush(); }

}  // namespace lcmslam
