#include <algorithm>
#include <array>
#include <cmath>

#include "octo3d/surfel_map_impl.h"

namespace lcmslam::octo3d {

namespace {

constexpr double kClippingTilt = 0.3;  // measured on simulated rooms

// The keys of one sweep's points repeat: beams side by side fall into the same leaf.
struct LeafCache {
  struct Slot {
    uint64_t key = ~uint64_t{0};
    SurfelNode* leaf = nullptr;
    Eigen::Vector3d centre;
  };
  Slot& operator[](uint64_t key) { return slots[(key * 0x9E3779B97F4A7C15ULL) >> 56]; }
  std::array<Slot, 256> slots;
};

}  // namespace

void SurfelMap::Impl::Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint) {
  ++revision;
  viewpoints.push_back(viewpoint);
  LeafCache cache;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d p = point.cast<double>();
    Key key;
    if (!ToKey(p, key)) continue;
    LeafCache::Slot& slot = cache[Pack(key)];
    if (slot.key != Pack(key)) slot = {Pack(key), TouchLeaf(key), Centre(key, 0)};
    slot.leaf->cell().statistics.Add(p - slot.centre);
  }
  UpdateTouched();
}

void SurfelMap::Impl::Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> seen_from) {
  ++revision;
  viewpoints.assign(seen_from.begin(), seen_from.end());
  viewpoints.emplace_back(Eigen::Vector3f::Zero());
  for (const LeafRecord& leaf : leaves) {
    SurfelCell& cell = TouchLeaf(Key(leaf.key[0], leaf.key[1], leaf.key[2]))->cell();
    cell.statistics = leaf.statistics;
    cell.viewpoint = leaf.viewpoint;
  }
  viewpoints.pop_back();
  UpdateTouched();
}

SurfelNode* SurfelMap::Impl::TouchLeaf(const Key& key) {
  SurfelNode* node = BlockOrNew(key);
  for (int level = block_level();; --level) {
    Touch(node, key, level);
    if (level == 0) return node;
    const unsigned child = octomap::computeChildIdx(key, level - 1);
    if (node->Child(child) == nullptr) {
      ++num_cells;
      num_leaves += level == 1;
    }
    node = tree.ChildOrNew(node, child);
  }
}

SurfelNode* SurfelMap::Impl::BlockOrNew(const Key& key) {
  const uint64_t block_key = BlockKey(key);
  if (SurfelNode* block = index.Find(block_key)) return block;
  SurfelNode* node = tree.Root();
  for (int level = kTreeDepth; level > block_level(); --level) {
    node = tree.ChildOrNew(node, octomap::computeChildIdx(key, level - 1));
  }
  index.Insert(block_key, node);
  ++num_cells;
  num_leaves += block_level() == 0;
  return node;
}

void SurfelMap::Impl::Touch(SurfelNode* node, const Key& key, int level) {
  if (node->cell().revision == revision) return;
  node->cell().revision = revision;
  node->cell().viewpoint = static_cast<uint32_t>(viewpoints.size() - 1);
  touched[level].push_back({node, key});
}

void SurfelMap::Impl::UpdateTouched() {
  for (int level = 1; level < options.levels; ++level) {
    for (const Touched& t : touched[level]) SumChildren(t.node, level);
  }
  for (int level = 0; level < options.levels; ++level) {
    for (const Touched& t : touched[level]) {
      const SurfelCell& cell = t.node->cell();
      const double due = std::max<double>(options.min_points, options.refit_growth * cell.plane.count);
      if (cell.statistics.count >= due) Refit(t.node, t.key, level);
    }
    touched[level].clear();
  }
}

void SurfelMap::Impl::SumChildren(SurfelNode* node, int level) const {
  PointStatistics sum;
  const double quarter = 0.25 * Edge(level);
  for (unsigned i = 0; i < 8; ++i) {
    const SurfelNode* child = node->Child(i);
    if (child == nullptr) continue;
    const Eigen::Vector3d offset(i & 1 ? quarter : -quarter, i & 2 ? quarter : -quarter, i & 4 ? quarter : -quarter);
    sum.Merge(child->cell().statistics, offset);
  }
  node->cell().statistics = sum;
}

// The extent must beat the noise, not only the thickness: a single ring of the lidar spreads along itself and, by its
// noise, along the beams, and these two span no surface.
bool SurfelMap::Impl::IsPlanar(const PointStatistics& statistics, const PlaneFit& fit) const {
  const double noise = options.range_noise_m * options.range_noise_m;
  // The variance of a sample of n varies by sqrt(2 / n) of itself.
  const double thickest = options.max_thickness * options.max_thickness * noise;
  return statistics.count >= options.min_points &&
         fit.variances[0] <= thickest * (1.0 + std::sqrt(2.0 / statistics.count)) &&
         fit.variances[1] >= options.min_flatness * std::max(noise, fit.variances[0]);
}

// A wall whose noise reaches over a face of the cell has left part of its points next door: fitted alone, each side
// would be drawn to its own half. So the face neighbour's points join the fit when together they are still one plane.
void SurfelMap::Impl::Refit(SurfelNode* node, const Key& key, int level) const {
  PointStatistics statistics = node->cell().statistics;
  PlaneFit fit = FitPlane(statistics);
  int axis = 0;
  fit.normal.cwiseAbs().maxCoeff(&axis);
  const double side = fit.mean[axis] < 0.0 ? -1.0 : 1.0;
  if (std::abs(fit.mean[axis]) + 2.0 * options.range_noise_m > 0.5 * Edge(level)) {
    Key neighbour_key = key;
    neighbour_key[axis] = static_cast<uint16_t>(key[axis] + static_cast<int>(side) * (1 << level));
    if (const SurfelNode* neighbour = Locate(neighbour_key, level)) {
      PointStatistics both = statistics;
      both.Merge(neighbour->cell().statistics, side * Edge(level) * Eigen::Vector3d::Unit(axis));
      const PlaneFit joint = FitPlane(both);
      if (IsPlanar(both, joint)) {
        statistics = both;
        fit = joint;
      }
    }
  }
  const double extent_var = std::max(fit.variances[1], 1e-12);
  // The faces cut a slanting plane off together with one side of its noise: a small cell tilts, whatever its count.
  const double tilt_m = kClippingTilt * options.range_noise_m * options.range_noise_m / std::sqrt(extent_var);
  CellPlane& plane = node->cell().plane;
  plane.mean = (fit.mean + Centre(key, level)).cast<float>();
  plane.normal = fit.normal.cast<float>();
  plane.thickness_var = static_cast<float>(fit.variances[0]);
  plane.height_var = static_cast<float>(fit.variances[0] / statistics.count + tilt_m * tilt_m);
  plane.per_extent = static_cast<float>(1.0 / extent_var);
  plane.count = static_cast<float>(node->cell().statistics.count);
  plane.revision = revision;
  plane.planar = IsPlanar(statistics, fit);
}

}  // namespace lcmslam::octo3d
