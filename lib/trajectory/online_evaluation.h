#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "trajectory/evaluate.h"

namespace lcmslam {

// The absolute error of an estimate while it and its reference are still coming in, in any interleaving: an estimate
// waits for the reference to pass its stamp. Late starts and gaps of the reference are counted; a stamp that steps back
// by more than a second starts a new segment, and the error so far anew; smaller steps back and repeated stamps are
// left out. One thread. Stamps within +-2^62 us, poses finite.
class OnlineEvaluation {
 public:
  explicit OnlineEvaluation(EvaluationOptions options) : options_(std::move(options)) {}

  void AddEstimate(const StampedPose& pose);
  void AddReference(const StampedPose& pose);

  struct Result {
    int64_t utime = 0;  // of the latest pair
    ErrorSummary error;
    double latest_error_m = 0.0;  // of the latest pair
    Alignment alignment;
    std::string text;  // what a person should know: gaps, late starts, steps of the clock
  };
  // Of the current segment. Aligns anew: O(pairs).
  Result ErrorSoFar() const;
  AlignmentKind alignment_kind() const { return ChooseAlignment(options_, is_planar_); }
  // Pairs of the current segment, not aligned. Poses that still wait for the reference are in none of the counts.
  const Association& association() const { return association_; }
  // The same when nothing more is to come: poses that still wait have no partner.
  Association FinalAssociation() const;
  std::string Describe() const;

 private:
  struct Stream {
    std::deque<StampedPose> waiting;  // estimates without, references with a possible partner to come
    std::optional<int64_t> last_utime;
  };

  // Whether the pose goes on from the stream's last one.
  bool Accept(const StampedPose& pose, Stream& stream, Stream& other);
  void StartSegment(int64_t utime, int64_t step_us, Stream& stream, Stream& other);
  void Match();

  EvaluationOptions options_;
  Stream estimate_, reference_;
  Association association_;
  std::optional<StampedPose> first_estimate_;
  bool is_planar_ = true;
  int segments_ = 1;
  double last_step_back_s_ = 0.0;
  int64_t out_of_order_ = 0;
};

}  // namespace lcmslam
