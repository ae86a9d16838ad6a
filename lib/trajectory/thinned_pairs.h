#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "trajectory/association.h"

namespace lcmslam {

// Of a run of any length a bounded number of pairs: evenly spaced ones, and from each stretch that one of them begins,
// the pair with the largest error. When there are too many stretches, neighbours become one. One thread.
class ThinnedPairs {
 public:
  using ErrorOf = std::function<double(const PosePair&)>;
  struct Stretch {
    PosePair first;
    PosePair worst;
  };

  // error_of: by the alignment as it is known now; called again for pairs of before when stretches become one.
  void Add(const PosePair& pair, const ErrorOf& error_of);

  const std::vector<Stretch>& stretches() const { return stretches_; }
  int64_t stride() const { return stride_; }  // pairs in each stretch, but for the last one, which may be shorter
  bool begins_stretch() const { return count_ % stride_ == 0; }  // the next pair does

 private:
  static constexpr size_t kMaxStretches = 2048;  // even

  void Halve(const ErrorOf& error_of);

  std::vector<Stretch> stretches_;
  int64_t stride_ = 1;
  int64_t count_ = 0;
};

}  // namespace lcmslam
