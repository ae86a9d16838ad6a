#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "octo3d/block_index.h"
#include "octo3d/surfel_map.h"
#include "octo3d/surfel_octree.h"

// Internal to SurfelMap: its members are defined in surfel_map_insert.cc, _find.cc and _read.cc.
namespace lcmslam::octo3d {

using Key = octomap::OcTreeKey;

inline constexpr int kTreeDepth = 16;  // OctoMap's
inline constexpr int kCentreKey = 1 << (kTreeDepth - 1);

inline uint64_t Pack(const Key& key) { return uint64_t{key[0]} | uint64_t{key[1]} << 16 | uint64_t{key[2]} << 32; }

class SurfelMap::Impl {
 public:
  explicit Impl(const MapOptions& map_options)
      : options(map_options), tree(map_options.leaf_m), touched(map_options.levels) {}

  void Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint);
  void Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> seen_from);
  void Find(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes) const;
  PlaneMatch FindNear(const Eigen::Vector3d& p, int level) const;
  std::vector<Surfel> ChangedSince(uint32_t since) const;
  std::vector<Surfel> InTurn(size_t& turn, size_t count) const;
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
  // A walk down to the cell of a point, and the best plane met on the way.
  struct Query {
    size_t index = 0;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    Key key{};
    const SurfelNode* node = nullptr;
    const CellPlane* best = nullptr;
    double best_score = std::numeric_limits<double>::infinity();
  };
  static constexpr size_t kBatch = 16;

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
  void FindBatch(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes, std::span<Query> queries) const;
  void FindOnPaths(std::span<Query> queries) const;
  Key BlockCorner(uint64_t block_key) const;
  bool Collect(const SurfelNode* node, const Key& key, int level, uint32_t since, std::vector<Surfel>& surfels) const;
  Surfel ToSurfel(const SurfelCell& cell, const Key& key, int level) const;
  void CollectLeaves(const SurfelNode* node, const Key& key, int level, std::vector<LeafRecord>& leaves) const;

  std::vector<std::vector<Touched>> touched;  // by level; of the insertion under way
};

}  // namespace lcmslam::octo3d
