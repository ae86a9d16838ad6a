#include <algorithm>
#include <cmath>

#include "octo3d/surfel_map_impl.h"

namespace lcmslam::octo3d {

namespace {

Key ChildKey(const Key& key, unsigned child, int child_level) {
  const int half = 1 << child_level;
  return {static_cast<uint16_t>(key[0] + (child & 1 ? half : 0)),
          static_cast<uint16_t>(key[1] + (child & 2 ? half : 0)),
          static_cast<uint16_t>(key[2] + (child & 4 ? half : 0))};
}

}  // namespace

Key SurfelMap::Impl::BlockCorner(uint64_t block_key) const {
  const int shift = block_level();
  return {static_cast<uint16_t>(block_key << shift), static_cast<uint16_t>(block_key >> 16 << shift),
          static_cast<uint16_t>(block_key >> 32 << shift)};
}

// Where the points of the cell lie on the plane, which may have been fitted to a neighbour's points too.
Surfel SurfelMap::Impl::ToSurfel(const SurfelCell& cell, const Key& key, int level) const {
  const CellPlane& plane = cell.plane;
  const float inside = 0.4999F * static_cast<float>(Edge(level));
  const Eigen::Vector3f centre = Centre(key, level).cast<float>();
  Eigen::Vector3f offset = cell.statistics.Mean().cast<float>();
  offset -= plane.normal.dot(centre + offset - plane.mean) * plane.normal;
  offset = offset.cwiseMax(-inside).cwiseMin(inside);
  const float side = (viewpoints[cell.viewpoint] - plane.mean).dot(plane.normal) < 0.0F ? -1.0F : 1.0F;
  return {centre + offset, side * plane.normal, static_cast<float>(Edge(level)), std::sqrt(plane.thickness_var),
          static_cast<uint32_t>(cell.statistics.count)};
}

// Returns whether `node` or anything below it is planar; only the finest planar cells are surfels.
bool SurfelMap::Impl::Collect(const SurfelNode* node, const Key& key, int level, uint32_t since,
                              std::vector<Surfel>& surfels) const {
  bool finer = false;
  for (unsigned i = 0; i < 8 && level > 0; ++i) {
    const SurfelNode* child = node->Child(i);
    if (child != nullptr) finer |= Collect(child, ChildKey(key, i, level - 1), level - 1, since, surfels);
  }
  const CellPlane& plane = node->cell().plane;
  if (finer || !plane.planar) return finer;
  if (plane.revision > since) surfels.push_back(ToSurfel(node->cell(), key, level));
  return true;
}

std::vector<Surfel> SurfelMap::Impl::ChangedSince(uint32_t since) const {
  std::vector<Surfel> surfels;
  index.ForEach([&](uint64_t block_key, const SurfelNode* block) {
    if (block->cell().revision > since) Collect(block, BlockCorner(block_key), block_level(), since, surfels);
  });
  return surfels;
}

std::vector<Surfel> SurfelMap::Impl::InTurn(size_t& turn, size_t count) const {
  std::vector<Surfel> surfels;
  for (size_t visited = 0; visited < index.num_slots() && surfels.size() < count; ++visited) {
    turn = turn + 1 < index.num_slots() ? turn + 1 : 0;
    index.VisitSlot(turn, [&](uint64_t block_key, const SurfelNode* block) {
      Collect(block, BlockCorner(block_key), block_level(), 0, surfels);
    });
  }
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
    CollectLeaves(child, ChildKey(key, i, level - 1), level - 1, leaves);
  }
}

std::vector<LeafRecord> SurfelMap::Impl::Leaves() const {
  std::vector<LeafRecord> leaves;
  leaves.reserve(num_leaves);
  index.ForEach([&](uint64_t block_key, const SurfelNode* block) {
    CollectLeaves(block, BlockCorner(block_key), block_level(), leaves);
  });
  std::ranges::sort(leaves, {}, &LeafRecord::key);
  return leaves;
}

}  // namespace lcmslam::octo3d
