#include "trajectory/thinned_pairs.h"

namespace lcmslam {

void ThinnedPairs::Add(const PosePair& pair, const ErrorOf& error_of) {
  if (begins_stretch()) {
    if (stretches_.size() == kMaxStretches) Halve(error_of);
    stretches_.push_back({pair, pair});
  } else if (PosePair& worst = stretches_.back().worst; error_of(pair) > error_of(worst)) {
    worst = pair;
  }
  ++count_;
}

void ThinnedPairs::Halve(const ErrorOf& error_of) {
  for (size_t i = 0; i < kMaxStretches / 2; ++i) {
    const Stretch &a = stretches_[2 * i], &b = stretches_[2 * i + 1];
    stretches_[i] = {a.first, error_of(b.worst) > error_of(a.worst) ? b.worst : a.worst};
  }
  stretches_.resize(kMaxStretches / 2);
  stride_ *= 2;
}

}  // namespace lcmslam
