#include "bus/progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace lcmslam {

Progress::Progress(uint64_t total, bool quiet)
    : total_(total), visible_(!quiet && total > 0 && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (visible_) fmt::print(stderr, "\r\033[K");
}

void Progress::Show(uint64_t done) {
  if (!visible_) return;
  const int percent = static_cast<int>(100 * done / total_);
  if (percent == shown_percent_) return;
  shown_percent_ = percent;
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3} %", "", percent / 2, "", 50 - percent / 2, percent);
}

}  // namespace lcmslam
