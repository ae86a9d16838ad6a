#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trajectory/evaluate.h"
#include "trajectory/thinned_pairs.h"

namespace lcmslam {

// The absolute error of an estimate while it and its reference are still coming in, in any interleaving: an estimate
// waits for the reference to pass its stamp. What goes wrong is counted and said:
//   late starts and gaps of the reference;
//   stamps that step ahead of the other stream by more than a second; when they come back before the other stream
//   has followed, what was ahead is left out;
//   stamps that step back by more than a second: a new segment begins, and the error so far anew;
//   smaller steps back and repeated stamps: left out.
// Memory and the cost of a call are bounded, however long the run. One thread. Stamps within +-2^62 us, poses finite.
class OnlineEvaluation {
 public:
  explicit OnlineEvaluation(EvaluationOptions options) : options_(std::move(options)) {}

  void AddEstimate(const StampedPose& pose);
  void AddReference(const StampedPose& pose);

  struct Result {
    int64_t utime = 0;      // of the latest pair
    int64_t matched = 0;    // poses of the estimate with a partner
    int64_t unmatched = 0;  // without, but for those that still wait for the reference
    double coverage = 0.0;
    ErrorSummary error;           // over all pairs of a short run, over evenly spaced ones of a long one; max over all
    double latest_error_m = 0.0;  // of the latest pair
    Alignment alignment;          // by all pairs
    std::string text;             // what a person should know: gaps, late starts, steps of the clock
  };
  // Of the current segment.
  Result ErrorSoFar() const;
  AlignmentKind alignment_kind() const { return ChooseAlignment(options_, is_planar_); }
  // What went wrong so far.
  std::string Describe() const;

  int segment() const { return segment_; }  // from 1
  // The pairs of the current segment since the last call, not aligned. They are kept until taken.
  std::vector<PosePair> TakePairs() { return std::exchange(new_pairs_, {}); }
  // The segment as a whole, of the pairs that were taken, when nothing more is to come: poses that still wait have no
  // partner.
  Association FinalAssociation(std::vector<PosePair> pairs) const;

 private:
  struct Stream {
    std::deque<StampedPose> waiting;  // estimates without, references with a possible partner to come
    std::optional<int64_t> last_utime;
    std::optional<int64_t> utime_before_step;  // when the stamps have stepped ahead
  };

  // Whether the pose goes on from the stream's last one.
  bool Accept(const StampedPose& pose, Stream& stream, Stream& other);
  void NoteStepAhead(int64_t utime, Stream& stream, const Stream& other);
  // Whether the stamps have come back from a step ahead.
  bool UndoStepAhead(int64_t utime, Stream& stream);
  void ConfirmStepAhead(int64_t utime, Stream& stream);
  void StartSegment(int64_t utime, int64_t step_us, Stream& stream, Stream& other);
  void Match();
  void AddPair(const PosePair& pair);
  Alignment AlignSoFar() const;

  EvaluationOptions options_;
  Stream estimate_, reference_;
  std::optional<StampedPose> first_estimate_;
  bool is_planar_ = true;
  int segment_ = 1;
  double last_step_back_s_ = 0.0;
  double last_step_ahead_s_ = 0.0;
  int64_t out_of_order_ = 0;

  // Of the current segment.
  struct Pairs {
    std::optional<PosePair> first;
    PosePair latest;
    PairMoments moments, moments_in_plane;
    ThinnedPairs thinned;
    Alignment alignment;  // at the start of the latest stretch of `thinned`
  };
  Pairs pairs_;
  int64_t before_ = 0, after_ = 0, in_gap_ = 0;  // as in Association
  std::vector<PosePair> new_pairs_;
};

}  // namespace lcmslam
