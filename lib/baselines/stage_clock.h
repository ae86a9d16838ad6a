#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>

namespace lcmslam {

// Times the stages of one scan in milliseconds; all zero without a clock.
template <typename Stage, size_t kNumStages>
class StageClock {
 public:
  explicit StageClock(const std::function<double()>& now_ms) : now_ms_(now_ms), last_ms_(now_ms ? now_ms() : 0.0) {}

  void Finish(Stage stage) {
    if (!now_ms_) return;
    const double now = now_ms_();
    stage_ms_[static_cast<size_t>(stage)] = now - std::exchange(last_ms_, now);
  }
  const std::array<double, kNumStages>& stage_ms() const { return stage_ms_; }

 private:
  const std::function<double()>& now_ms_;
  double last_ms_;
  std::array<double, kNumStages> stage_ms_{};
};

}  // namespace lcmslam
