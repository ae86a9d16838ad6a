#include <algorithm>
#include <limits>

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

}  // namespace lcmslam::octo3d
