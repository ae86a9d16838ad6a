#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lcmslam::octo3d {

class SurfelNode;

// Flat open-addressing hash from the key of a block (a cell at a fixed octree depth) to its node: it replaces the walk
// from the octree's root. Linear probing, at most half full; no removal. Find is safe from several threads.
class BlockIndex {
 public:
  BlockIndex();

  SurfelNode* Find(uint64_t key) const {
    for (size_t slot = Home(key);; slot = (slot + 1) & mask_) {
      if (slots_[slot].key == key) return slots_[slot].node;
      if (slots_[slot].node == nullptr) return nullptr;
    }
  }
  // key must be new; node not null.
  void Insert(uint64_t key, SurfelNode* node);
  void Clear();
  size_t num_slots() const { return slots_.size(); }
  size_t size() const { return size_; }

  // Calls visit(key, node) for every block, in an order that depends on the keys and their number only.
  template <typename Visit>
  void ForEach(Visit visit) const {
    for (size_t slot = 0; slot < slots_.size(); ++slot) VisitSlot(slot, visit);
  }
  // slot: below num_slots(); visits at most one block.
  template <typename Visit>
  void VisitSlot(size_t slot, Visit visit) const {
    if (slots_[slot].node != nullptr) visit(slots_[slot].key, slots_[slot].node);
  }

 private:
  struct Slot {
    uint64_t key = ~uint64_t{0};
    SurfelNode* node = nullptr;
  };

  // Fibonacci hashing.
  size_t Home(uint64_t key) const { return (key * 0x9E3779B97F4A7C15ULL) >> shift_; }
  void Grow();

  std::vector<Slot> slots_;
  size_t mask_ = 0;
  int shift_ = 0;
  size_t size_ = 0;
};

}  // namespace lcmslam::octo3d
