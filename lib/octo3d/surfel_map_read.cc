#include <algorithm>
#include <cmath>

#include "octo3d/surfel_map_impl.h"

namespace lcmslam::octo3d {

// Returns whether `node` or anything below it is planar; only the finest planar cells are surfels.
bool SurfelMap::Impl::Collect(const SurfelNode* node, int level, uint32_t since, std::vector<Surfel>& surfels) const {
  bool finer = false;
  for (unsigned i = 0; i < 8 && level > 0; ++i) {
    const SurfelNode* child = node->Child(i);
    if (child != nullptr) finer |= Collect(child, level - 1, since, surfels);
  }
  const SurfelCell& cell = node->cell();
  if (finer || !cell.plane.planar) return finer;
  if (cell.revision > since) {
    const Eigen::Vector3f to_viewer = viewpoints[cell.viewpoint] - cell.plane.mean;
    const float side = to_viewer.dot(cell.plane.normal) < 0.0F ? -1.0F : 1.0F;
    surfels.push_back({cell.plane.mean, side * cell.plane.normal, static_cast<float>(Edge(level)),
                       std::sqrt(cell.plane.thickness_var), static_cast<uint32_t>(cell.statistics.count)});
  }
  return true;
}

std::vector<Surfel> SurfelMap::Impl::ChangedSince(uint32_t since) const {
  std::vector<Surfel> surfels;
  index.ForEach([&](uint64_t, const SurfelNode* block) {
    if (block->cell().revision > since) Collect(block, block_level(), since, surfels);
  });
  return surfels;
}

void SurfelMap::Impl::CollectLeaves(const SurfelNode* node, const Key& key, int level,
                                    std::vector<LeafRecord>& leaves) const {
  if (level == 0) {
    leaves.push_back({{key[0], key[1], key[2]}, Centre(key, 0), node->cell().statistics, node->cell().viewpoint});
    return;
  }
  for (unsigned i = 0; i < 8; ++i) {
    const SurfelNode* child = node->Child(i);
    if (child == nullptr) continue;
    const int half = 1 << (level - 1);
    const Key child_key(key[0] + (i & 1 ? half : 0), key[1] + (i & 2 ? half : 0), key[2] + (i & 4 ? half : 0));
    CollectLeaves(child, child_key, level - 1, leaves);
  }
}

std::vector<LeafRecord> SurfelMap::Impl::Leaves() const {
  std::vector<LeafRecord> leaves;
  leaves.reserve(num_leaves);
  index.ForEach([&](uint64_t packed, const SurfelNode* block) {
    const int shift = block_level();
    const Key key(static_cast<uint16_t>(packed << shift), static_cast<uint16_t>(packed >> 16 << shift),
                  static_cast<uint16_t>(packed >> 32 << shift));
    CollectLeaves(block, key, block_level(), leaves);
  });
  std::ranges::sort(leaves, {}, &LeafRecord::key);
  return leaves;
}

}  // namespace lcmslam::octo3d
