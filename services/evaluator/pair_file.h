#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "trajectory/association.h"

namespace lcmslam {

// All pairs of a live run, for its final report: in a temporary file without a name, so that a run of any length takes
// no memory. One thread.
class PairFile {
 public:
  PairFile();

  void Add(std::span<const PosePair> pairs);
  void Clear();
  // In the order they came. None when the file could not take them all.
  [[nodiscard]] std::optional<std::vector<PosePair>> ReadAll();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  size_t count_ = 0;
  bool is_complete_ = true;
};

}  // namespace lcmslam
