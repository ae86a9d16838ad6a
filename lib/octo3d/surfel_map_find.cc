#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "octo3d/surfel_map_impl.h"

namespace lcmslam::octo3d {

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

const SurfelNode* SurfelMap::Impl::Locate(const Key& key, int level) const {
  const SurfelNode* node = index.Find(BlockKey(key));
  for (int l = block_level(); node != nullptr && l > level; --l)
    node = node->Child(octomap::computeChildIdx(key, l - 1));
  return node;
}

// Walks down for all of them at once, so that their waits for memory overlap.
void SurfelMap::Impl::FindOnPaths(std::span<Query> queries) const {
  for (Query& query : queries) query.node = index.Find(BlockKey(query.key));
  for (int level = block_level(); level >= 0; --level) {
    const double model_error = options.curvature_per_m * Edge(level) * Edge(level);
    for (Query& query : queries) {
      if (query.node == nullptr) continue;
      const CellPlane& plane = query.node->cell().plane;
      if (plane.planar) {
        const double distance2 = (query.p - plane.mean.cast<double>()).squaredNorm();
        const double score = plane.height_var * (1.0 + distance2 * plane.per_extent) + model_error * model_error;
        if (score < query.best_score) {
          query.best_score = score;
          query.best = &plane;
        }
      }
      query.node = level > 0 ? query.node->Child(octomap::computeChildIdx(query.key, level - 1)) : nullptr;
      __builtin_prefetch(query.node);
    }
  }
}

void SurfelMap::Impl::Find(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes) const {
  std::array<Query, kBatch> queries;
  for (size_t first = 0; first < points.size(); first += kBatch) {
    const size_t size = std::min(kBatch, points.size() - first);
    FindBatch(points.subspan(first, size), planes.subspan(first, size), queries);
  }
}

void SurfelMap::Impl::FindBatch(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes,
                                std::span<Query> queries) const {
  size_t size = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    planes[i] = {};
    Query& query = queries[size];
    if (!ToKey(points[i], query.key)) continue;
    query.index = i;
    query.p = points[i];
    query.best = nullptr;
    query.best_score = std::numeric_limits<double>::infinity();
    ++size;
  }
  queries = queries.first(size);
  FindOnPaths(queries);
  const auto missed = std::partition(queries.begin(), queries.end(), [](const Query& q) { return q.best != nullptr; });
  const std::span<Query> others(missed, queries.end());
  for (Query& query : others) {
    // The nearest face of the second finest cell leads to the neighbour.
    const int level = std::min(1, block_level());
    const Eigen::Vector3d offset = query.p - Centre(query.key, level);
    int axis = 0;
    offset.cwiseAbs().maxCoeff(&axis);
    query.key[axis] = static_cast<uint16_t>(query.key[axis] + (offset[axis] < 0.0 ? -1 : 1) * (1 << level));
  }
  FindOnPaths(others);
  for (const Query& query : queries) {
    if (query.best == nullptr) continue;
    const CellPlane& plane = *query.best;
    planes[query.index] = {true, plane.mean.cast<double>(), plane.normal.cast<double>(), query.best_score,
                           plane.height_var * plane.per_extent};
  }
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
    nearest = {true, plane.mean.cast<double>(), plane.normal.cast<double>(), plane.height_var,
               plane.height_var * plane.per_extent};
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

}  // namespace lcmslam::octo3d
