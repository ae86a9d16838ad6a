#include "octo3d/block_index.h"

#include <utility>

namespace lcmslam::octo3d {

namespace {
constexpr int kInitialBits = 10;
}

BlockIndex::BlockIndex() { Clear(); }

void BlockIndex::Clear() {
  slots_.assign(size_t{1} << kInitialBits, Slot{});
  mask_ = slots_.size() - 1;
  shift_ = 64 - kInitialBits;
  size_ = 0;
}

void BlockIndex::Insert(uint64_t key, SurfelNode* node) {
  if (2 * (size_ + 1) > slots_.size()) Grow();
  size_t slot = Home(key);
  while (slots_[slot].node != nullptr) slot = (slot + 1) & mask_;
  slots_[slot] = {key, node};
  ++size_;
}

void BlockIndex::Grow() {
  std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  mask_ = slots_.size() - 1;
  --shift_;
  size_ = 0;
  for (const Slot& slot : old) {
    if (slot.node != nullptr) Insert(slot.key, slot.node);
  }
}

}  // namespace lcmslam::octo3d
