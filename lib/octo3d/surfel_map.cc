#include "octo3d/surfel_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "octo3d/block_index.h"
#include "octo3d/surfel_octree.h"

namespace lcmslam::octo3d {

namespace {

using Key = octomap::OcTreeKey;

constexpr int kTreeDepth = 16;  // OctoMap's
constexpr int kCentreKey = 1 << (kTreeDepth - 1);
constexpr double kClippingTilt = 0.3;  // measured on simulated rooms

uint64_t Pack(const Key& key) { return uint64_t{key[0]} | uint64_t{key[1]} << 16 | uint64_t{key[2]} << 32; }

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

class SurfelMap::Impl {
 public:
  explicit Impl(const MapOptions& map_options)
      : options(map_options), tree(map_options.leaf_m), touched(map_options.levels) {}

  void Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint);
  void Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> seen_from);
  PlaneMatch Find(const Eigen::Vector3d& p) const;
  PlaneMatch FindNear(const Eigen::Vector3d& p, int level) const;
  std::vector<Surfel> ChangedSince(uint32_t since) const;
  std::vector<LeafRecord> Leaves() const;

  const MapOptions options;
  const double leaves_per_m = 1.0 / options.leaf_m;
  SurfelOctree tree;
  BlockIndex index;
  uint32_t revision = 0;
  size_t num_cells = 0, num_leaves = 0;
  std::vector<Eigen::Vector3f> viewpoints;

 private:
  struct Touched {
    SurfelNode* node;
    Key key;
  };

  double Edge(int level) const { return options.leaf_m * (1 << level); }
  int block_level() const { return options.levels - 1; }
  uint64_t BlockKey(const Key& key) const {
    const int shift = block_level();
    return Pack(Key(key[0] >> shift, key[1] >> shift, key[2] >> shift));
  }
  Eigen::Vector3d Centre(const Key& key, int level) const;
  bool ToKey(const Eigen::Vector3d& p, Key& key) const;

  SurfelNode* TouchLeaf(const Key& key);
  SurfelNode* BlockOrNew(const Key& key);
  void Touch(SurfelNode* node, const Key& key, int level);
  const SurfelNode* Locate(const Key& key, int level) const;
  void UpdateTouched();
  void SumChildren(SurfelNode* node, int level) const;
  void Refit(SurfelNode* node, const Key& key, int level) const;
  bool IsPlanar(const PointStatistics& statistics, const PlaneFit& fit) const;
  void FindOnPath(const Key& key, const Eigen::Vector3d& p, double& best_score, PlaneMatch& best) const;
  bool Collect(const SurfelNode* node, int level, uint32_t since, std::vector<Surfel>& surfels) const;
  void CollectLeaves(const SurfelNode* node, const Key& key, int level, std::vector<LeafRecord>& leaves) const;

  std::vector<std::vector<Touched>> touched;  // by level; of the insertion under way
};

Eigen::Vector3d SurfelMap::Impl::Centre(const Key& key, int level) const {
  Eigen::Vector3d centre;
  for (int axis = 0; axis < 3; ++axis) {
    centre[axis] = ((((key[axis] >> level) << level) - kCentreKey) + 0.5 * (1 << level)) * options.leaf_m;
  }
  return centre;
}

bool SurfelMap::Impl::ToKey(const Eigen::Vector3d& p, Key& key) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = p[axis] * leaves_per_m + kCentreKey;
    if (!(cell >= 0.0 && cell < 2.0 * kCentreKey)) return false;  // also NaN
    key[axis] = static_cast<uint16_t>(static_cast<int>(cell));    // not negative, so this is the floor
  }
  return true;
}

// --- insertion ---

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
  plane.planar = IsPlanar(statistics, fit);
}

// --- association ---

const SurfelNode* SurfelMap::Impl::Locate(const Key& key, int level) const {
  const SurfelNode* node = index.Find(BlockKey(key));
  for (int l = block_level(); node != nullptr && l > level; --l)
    node = node->Child(octomap::computeChildIdx(key, l - 1));
  return node;
}

void SurfelMap::Impl::FindOnPath(const Key& key, const Eigen::Vector3d& p, double& best_score, PlaneMatch& best) const {
  const SurfelNode* node = index.Find(BlockKey(key));
  for (int level = block_level(); node != nullptr; --level) {
    const CellPlane& plane = node->cell().plane;
    if (plane.planar) {
      const Eigen::Vector3d mean = plane.mean.cast<double>();
      const double variance = plane.height_var * (1.0 + (p - mean).squaredNorm() * plane.per_extent);
      const double model_error = options.curvature_per_m * Edge(level) * Edge(level);
      const double score = variance + model_error * model_error;
      if (score < best_score) {
        best_score = score;
        best = {true, mean, plane.normal.cast<double>(), score};
      }
    }
    if (level == 0) break;
    node = node->Child(octomap::computeChildIdx(key, level - 1));
  }
}

PlaneMatch SurfelMap::Impl::Find(const Eigen::Vector3d& p) const {
  PlaneMatch best;
  Key key;
  if (!ToKey(p, key)) return best;
  double best_score = std::numeric_limits<double>::infinity();
  FindOnPath(key, p, best_score, best);
  if (best.found) return best;
  // The nearest face of the second finest cell leads to the neighbour.
  const int level = std::min(1, block_level());
  const Eigen::Vector3d offset = p - Centre(key, level);
  int axis = 0;
  offset.cwiseAbs().maxCoeff(&axis);
  key[axis] = static_cast<uint16_t>(key[axis] + (offset[axis] < 0.0 ? -1 : 1) * (1 << level));
  FindOnPath(key, p, best_score, best);
  return best;
}

PlaneMatch SurfelMap::Impl::FindNear(const Eigen::Vector3d& p, int level) const {
  PlaneMatch nearest;
  Key centre;
  if (!ToKey(p, centre)) return nearest;
  double nearest2 = std::numeric_limits<double>::infinity();
  const auto consider = [&](const SurfelNode* node) {
    if (node == nullptr || !node->cell().plane.planar) return;
    const CellPlane& plane = node->cell().plane;
    const double distance2 = (plane.mean.cast<double>() - p).squaredNorm();
    if (distance2 >= nearest2) return;
    nearest2 = distance2;
    nearest = {true, plane.mean.cast<double>(), plane.normal.cast<double>(), plane.height_var};
  };
  const int step = 1 << level;
  for (int i = 0; i < 27; ++i) {
    const Key key(centre[0] + (i % 3 - 1) * step, centre[1] + (i / 3 % 3 - 1) * step, centre[2] + (i / 9 - 1) * step);
    const SurfelNode* node = Locate(key, level);
    if (node == nullptr) continue;
    consider(node);
    for (unsigned child = 0; child < 8; ++child) consider(node->Child(child));
  }
  return nearest;
}

// --- reading out ---

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

// --- the public face ---

SurfelMap::SurfelMap(const MapOptions& options) : impl_(std::make_unique<Impl>(options)) {}
SurfelMap::~SurfelMap() = default;
SurfelMap::SurfelMap(SurfelMap&&) noexcept = default;
SurfelMap& SurfelMap::operator=(SurfelMap&&) noexcept = default;

void SurfelMap::Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint) {
  impl_->Insert(points, viewpoint);
}
PlaneMatch SurfelMap::Find(const Eigen::Vector3d& p) const { return impl_->Find(p); }
PlaneMatch SurfelMap::FindNear(const Eigen::Vector3d& p, int level) const {
  return impl_->FindNear(p, std::clamp(level, 0, impl_->options.levels - 1));
}
std::vector<Surfel> SurfelMap::ChangedSince(uint32_t revision) const { return impl_->ChangedSince(revision); }
std::vector<LeafRecord> SurfelMap::Leaves() const { return impl_->Leaves(); }
void SurfelMap::Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> viewpoints) {
  Clear();
  impl_->Restore(leaves, viewpoints);
}
void SurfelMap::Clear() {
  const uint32_t revision = impl_->revision;
  impl_ = std::make_unique<Impl>(impl_->options);
  impl_->revision = revision;  // keeps growing, so that ChangedSince() never misses a rebuilt map
}
uint32_t SurfelMap::revision() const { return impl_->revision; }
size_t SurfelMap::num_cells() const { return impl_->num_cells; }
size_t SurfelMap::num_leaves() const { return impl_->num_leaves; }
const std::vector<Eigen::Vector3f>& SurfelMap::viewpoints() const { return impl_->viewpoints; }
const MapOptions& SurfelMap::options() const { return impl_->options; }

}  // namespace lcmslam::octo3d
