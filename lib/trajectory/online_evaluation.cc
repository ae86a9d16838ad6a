#include "trajectory/online_evaluation.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace lcmslam {
namespace {

constexpr int64_t kSecondUs = 1'000'000;
constexpr size_t kMaxWaiting = 100'000;  // of one stream, when the other stays away

double Seconds(int64_t us) { return static_cast<double>(us) * 1e-6; }

std::string Poses(int64_t count) { return fmt::format("{} pose{}", count, count == 1 ? "" : "s"); }

// The pair as `alignment` puts it: both sides in the world frame, in the plane for se2.
PosePair Aligned(PosePair pair, const Alignment& alignment) {
  if (alignment.kind == AlignmentKind::kSe2) FlattenToPlane({&pair, 1});
  Apply(alignment.T_world_map, {&pair, 1});
  return pair;
}

double PositionError(const PosePair& pair, const Alignment& alignment) {
  const PosePair aligned = Aligned(pair, alignment);
  return (aligned.reference.translation - aligned.estimate.translation).norm();
}

}  // namespace

void OnlineEvaluation::AddEstimate(const StampedPose& pose) {
  if (!Accept(pose, estimate_, reference_)) return;
  if (!first_estimate_) first_estimate_ = pose;
  is_planar_ = is_planar_ && IsPlanar(std::array{*first_estimate_, pose});
  estimate_.waiting.push_back(pose);
  if (estimate_.waiting.size() > kMaxWaiting) {
    estimate_.waiting.pop_front();
    ++after_;
  }
  Match();
}

void OnlineEvaluation::AddReference(const StampedPose& pose) {
  if (!Accept(pose, reference_, estimate_)) return;
  reference_.waiting.push_back(pose);
  if (reference_.waiting.size() > kMaxWaiting) reference_.waiting.pop_front();
  Match();
}

bool OnlineEvaluation::Accept(const StampedPose& pose, Stream& stream, Stream& other) {
  if (stream.last_utime && pose.utime <= *stream.last_utime) {
    const int64_t step_us = *stream.last_utime - pose.utime;
    if (step_us <= kSecondUs) {
      ++out_of_order_;
      return false;
    }
    if (!UndoStepAhead(pose.utime, stream)) StartSegment(pose.utime, step_us, stream, other);
  } else {
    NoteStepAhead(pose.utime, stream, other);
  }
  stream.last_utime = pose.utime;
  return true;
}

// When the other stream was silent as well, or was the first to step, this is no step of its own.
void OnlineEvaluation::NoteStepAhead(int64_t utime, Stream& stream, const Stream& other) {
  if (!stream.last_utime || !other.last_utime) return;
  const int64_t step_us = utime - *stream.last_utime;
  const int64_t ahead_us = utime - *other.last_utime;
  if (step_us <= kSecondUs || ahead_us <= kSecondUs) return;
  last_step_ahead_s_ = Seconds(std::min(step_us, ahead_us));
  stream.utime_before_step = stream.last_utime;
}

bool OnlineEvaluation::UndoStepAhead(int64_t utime, Stream& stream) {
  if (!stream.utime_before_step || utime <= *stream.utime_before_step) return false;
  const auto is_ahead = [&](const StampedPose& p) { return p.utime > *stream.utime_before_step; };
  out_of_order_ += static_cast<int64_t>(std::erase_if(stream.waiting, is_ahead));
  stream.utime_before_step.reset();
  return true;
}

// Where both streams have gone on, there is no way back.
void OnlineEvaluation::ConfirmStepAhead(int64_t utime, Stream& stream) {
  if (stream.utime_before_step && utime > *stream.utime_before_step) stream.utime_before_step.reset();
}

// The other stream may have stepped back already: what it has from then on stays, and is no further segment.
void OnlineEvaluation::StartSegment(int64_t utime, int64_t step_us, Stream& stream, Stream& other) {
  stream.waiting.clear();
  stream.utime_before_step.reset();
  const bool other_has_stepped = other.last_utime && *other.last_utime <= utime + kSecondUs;
  if (other_has_stepped) return;
  other.waiting.clear();
  pairs_ = {};
  before_ = after_ = in_gap_ = 0;
  last_step_ahead_s_ = 0.0;
  new_pairs_.clear();
  ++segment_;
  last_step_back_s_ = Seconds(step_us);
}

void OnlineEvaluation::Match() {
  auto& references = reference_.waiting;
  for (auto& estimates = estimate_.waiting; !estimates.empty(); estimates.pop_front()) {
    const StampedPose& estimate = estimates.front();
    const int64_t utime = estimate.utime + options_.association.time_offset_us;
    while (references.size() > 1 && references[1].utime <= utime) references.pop_front();
    if (references.empty() || references.back().utime < utime) return;
    if (references.front().utime > utime) {
      ++before_;
      continue;
    }
    const std::array neighbours{references.front(), references[references.size() > 1 ? 1 : 0]};
    if (const auto pose = InterpolateAt(neighbours, utime, options_.association.max_gap_us)) {
      AddPair({estimate.utime, estimate.pose, *pose});
    } else {
      ++in_gap_;
    }
  }
}

void OnlineEvaluation::AddPair(const PosePair& pair) {
  ConfirmStepAhead(pair.utime, estimate_);
  ConfirmStepAhead(pair.utime + options_.association.time_offset_us, reference_);
  if (!pairs_.first) pairs_.first = pair;
  pairs_.latest = pair;
  pairs_.moments.Add(pair);
  pairs_.moments_in_plane.Add(Aligned(pair, {.kind = AlignmentKind::kSe2, .T_world_map = {}}));
  if (pairs_.thinned.begins_stretch()) pairs_.alignment = AlignSoFar();
  pairs_.thinned.Add(pair, [this](const PosePair& p) { return PositionError(p, pairs_.alignment); });
  new_pairs_.push_back(pair);
}

Alignment OnlineEvaluation::AlignSoFar() const {
  const AlignmentKind kind = alignment_kind();
  if (kind != AlignmentKind::kSe2) return Align(pairs_.moments, *pairs_.first, kind, options_.align);
  return Align(pairs_.moments_in_plane, *pairs_.first, kind, options_.align);
}

Association OnlineEvaluation::FinalAssociation(std::vector<PosePair> pairs) const {
  const auto waiting = static_cast<int64_t>(estimate_.waiting.size());
  return {.pairs = std::move(pairs), .before = before_, .after = after_ + waiting, .in_gap = in_gap_};
}

OnlineEvaluation::Result OnlineEvaluation::ErrorSoFar() const {
  Result result;
  result.text = Describe();
  result.matched = pairs_.moments.count();
  result.unmatched = before_ + after_ + in_gap_;
  if (!pairs_.first) return result;
  result.coverage = static_cast<double>(result.matched) / static_cast<double>(result.matched + result.unmatched);
  result.alignment = AlignSoFar();
  PoseErrors errors;
  double max_m = 0.0;
  for (const auto& [first, worst] : pairs_.thinned.stretches()) {
    const PosePair aligned = Aligned(first, result.alignment);
    errors.Add(aligned.reference, aligned.estimate);
    max_m = std::max({max_m, errors.translation_m.back(), PositionError(worst, result.alignment)});
  }
  result.error = {Summarize(std::move(errors.translation_m)), Summarize(std::move(errors.rotation_rad))};
  result.error.translation_m.max = max_m;
  result.utime = pairs_.latest.utime;
  result.latest_error_m = PositionError(pairs_.latest, result.alignment);
  const int64_t stride = pairs_.thinned.stride();
  for (const std::string& part :
       {DescribeUnobservable(result.alignment), stride == 1 ? "" : fmt::format("mean over one pose in {}", stride)}) {
    if (!part.empty()) result.text += (result.text.empty() ? "" : "; ") + part;
  }
  return result;
}

std::string OnlineEvaluation::Describe() const {
  std::vector<std::string> parts;
  if (!estimate_.last_utime) parts.emplace_back("no estimate yet");
  if (!reference_.last_utime) parts.emplace_back("no reference yet");
  if (segment_ > 1) {
    parts.push_back(fmt::format("clock stepped back {:.3f} s, segment {}", last_step_back_s_, segment_));
  }
  if (last_step_ahead_s_ > 0.0) parts.push_back(fmt::format("clock stepped ahead {:.3f} s", last_step_ahead_s_));
  if (reference_.last_utime && !estimate_.waiting.empty()) {
    const double behind_s = Seconds(estimate_.waiting.back().utime - *reference_.last_utime);
    if (behind_s > Seconds(options_.association.max_gap_us)) {
      parts.push_back(fmt::format("no reference for {:.1f} s", behind_s));
    }
  }
  if (before_ > 0) parts.push_back(Poses(before_) + " before the reference began");
  if (in_gap_ > 0) parts.push_back(Poses(in_gap_) + " in gaps of the reference");
  if (out_of_order_ > 0) parts.push_back(Poses(out_of_order_) + " out of order left out");
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace lcmslam
