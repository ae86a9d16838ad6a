#pragma once

#include <cstdint>

namespace lcmslam {

// A progress bar on stderr; nothing when quiet or when stderr is no terminal.
class Progress {
 public:
  Progress(uint64_t total, bool quiet);
  ~Progress();
  void Show(uint64_t done);

 private:
  uint64_t total_;
  bool visible_;
  int shown_percent_ = -1;
};

}  // namespace lcmslam
