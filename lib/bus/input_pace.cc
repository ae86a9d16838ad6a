#include "bus/input_pace.h"

#include <algorithm>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kSilentUs = 500'000;         // for an input of 6 Hz or more; for a slower one
constexpr int64_t kSilentPeriods = 3;          // of its own periods
constexpr int64_t kClockStepUs = 10'000'000;   // not the pace of an input, but a clock that was set
constexpr int64_t kOtherSenderUs = 1'000'000;  // inputs of several senders need not come in the order of their stamps
constexpr int64_t kComparableUs = 200'000;     // what arrives in one go says nothing of its pace

}  // namespace

void InputPace::Note(int64_t stamp_utime, int64_t arrival_utime, int64_t now_utime) {
  const int64_t step_us = UtimeDifference(stamp_utime, last_.stamp_utime);
  if (step_us < -kOtherSenderUs || step_us > kClockStepUs) first_.reset();
  last_ = {stamp_utime, arrival_utime};
  taken_utime_ = now_utime;
  any_ = true;
  if (first_) {
    ++since_first_;
  } else {
    first_ = last_;
    since_first_ = 0;
  }
}

InputPaceReport InputPace::Report(int64_t now_utime) {
  InputPaceReport report;
  if (!any_) return report;
  const int64_t spanned_us = first_ ? UtimeDifference(last_.utime, first_->utime) : 0;
  if (spanned_us >= kComparableUs) {
    const auto spanned = static_cast<double>(spanned_us);
    report.pace = static_cast<double>(UtimeDifference(last_.stamp_utime, first_->stamp_utime)) / spanned;
    report.rate_hz = 1e6 * static_cast<double>(since_first_) / spanned;
    period_us_ = spanned_us / since_first_;
    first_ = last_;
    since_first_ = 0;
  }
  const int64_t silent_us = UtimeDifference(now_utime, taken_utime_);
  if (silent_us > std::max(kSilentUs, kSilentPeriods * period_us_)) {
    report.silent_s = 1e-6 * static_cast<double>(silent_us);
    first_.reset();
  }
  return report;
}

}  // namespace lcmslam
