#include "trajectory/online_evaluation.h"

#include <array>

#include <fmt/format.h>

namespace lcmslam {
namespace {

constexpr int64_t kSecondUs = 1'000'000;
constexpr size_t kMaxWaiting = 100'000;  // of one stream, when the other stays away

double Seconds(int64_t us) { return static_cast<double>(us) * 1e-6; }

std::string Poses(int64_t count) { return fmt::format("{} pose{}", count, count == 1 ? "" : "s"); }

}  // namespace

void OnlineEvaluation::AddEstimate(const StampedPose& pose) {
  if (!Accept(pose, estimate_, reference_)) return;
  if (!first_estimate_) first_estimate_ = pose;
  is_planar_ = is_planar_ && IsPlanar(std::array{*first_estimate_, pose});
  estimate_.waiting.push_back(pose);
  if (estimate_.waiting.size() > kMaxWaiting) {
    estimate_.waiting.pop_front();
    ++association_.after;
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
    StartSegment(pose.utime, step_us, stream, other);
  }
  stream.last_utime = pose.utime;
  return true;
}

// The other stream may have stepped back already: what it has from then on stays, and is no further segment.
void OnlineEvaluation::StartSegment(int64_t utime, int64_t step_us, Stream& stream, Stream& other) {
  stream.waiting.clear();
  const bool other_has_stepped = other.last_utime && *other.last_utime <= utime + kSecondUs;
  if (other_has_stepped) return;
  other.waiting.clear();
  association_ = {};
  ++segments_;
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
      ++association_.before;
      continue;
    }
    const std::array neighbours{references.front(), references[references.size() > 1 ? 1 : 0]};
    if (const auto pose = InterpolateAt(neighbours, utime, options_.association.max_gap_us)) {
      association_.pairs.push_back({estimate.utime, estimate.pose, *pose});
    } else {
      ++association_.in_gap;
    }
  }
}

Association OnlineEvaluation::FinalAssociation() const {
  Association association = association_;
  association.after += static_cast<int64_t>(estimate_.waiting.size());
  return association;
}

OnlineEvaluation::Result OnlineEvaluation::ErrorSoFar() const {
  Result result;
  result.text = Describe();
  std::vector<PosePair> pairs = association_.pairs;
  if (pairs.empty()) return result;
  const AlignmentKind kind = alignment_kind();
  if (kind == AlignmentKind::kSe2) FlattenToPlane(pairs);
  result.alignment = Align(pairs, kind, options_.align);
  Apply(result.alignment.T_world_map, pairs);
  const PoseErrors errors = AbsoluteErrors(pairs);
  result.utime = pairs.back().utime;
  result.error = {Summarize(errors.translation_m), Summarize(errors.rotation_rad)};
  result.latest_error_m = errors.translation_m.back();
  const std::string unobservable = DescribeUnobservable(result.alignment);
  if (!unobservable.empty()) result.text += (result.text.empty() ? "" : "; ") + unobservable;
  return result;
}

std::string OnlineEvaluation::Describe() const {
  std::vector<std::string> parts;
  if (!estimate_.last_utime) parts.emplace_back("no estimate yet");
  if (!reference_.last_utime) parts.emplace_back("no reference yet");
  if (segments_ > 1) {
    parts.push_back(fmt::format("clock stepped back {:.3f} s, segment {}", last_step_back_s_, segments_));
  }
  if (reference_.last_utime && !estimate_.waiting.empty()) {
    const double behind_s = Seconds(estimate_.waiting.back().utime - *reference_.last_utime);
    if (behind_s > Seconds(options_.association.max_gap_us)) {
      parts.push_back(fmt::format("no reference for {:.1f} s", behind_s));
    }
  }
  if (association_.before > 0) parts.push_back(Poses(association_.before) + " before the reference began");
  if (association_.in_gap > 0) parts.push_back(Poses(association_.in_gap) + " in gaps of the reference");
  if (out_of_order_ > 0) parts.push_back(Poses(out_of_order_) + " out of order left out");
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace lcmslam
