#include "octo3d/occupancy_export.h"

#include <algorithm>
#include <vector>

#include <octomap/OcTree.h>

namespace lcmslam::octo3d {

namespace {

octomap::point3d ToPoint(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

octomap::OcTree ToOccupancy(const SurfelMap& map, const OccupancyExportOptions& options) {
  octomap::OcTree tree(map.options().leaf_m);
  const float occupied = tree.getClampingThresMaxLog(), free = tree.getClampingThresMinLog();
  const std::vector<LeafRecord> leaves = map.Leaves();
  octomap::KeyRay ray;
  for (const LeafRecord& leaf : leaves) {
    if (!options.free_space) break;
    const octomap::point3d from = ToPoint(map.viewpoints()[leaf.viewpoint].cast<double>());
    if (from.distance(ToPoint(leaf.centre)) > options.max_ray_m ||
        !tree.computeRayKeys(from, ToPoint(leaf.centre), ray)) {
      continue;
    }
    for (const octomap::OcTreeKey& key : ray) {
      if (tree.search(key) == nullptr) tree.setNodeValue(key, free, true);
    }
  }
  for (const LeafRecord& leaf : leaves) {
    tree.setNodeValue(octomap::OcTreeKey(leaf.key[0], leaf.key[1], leaf.key[2]), occupied, true);
  }
  tree.updateInnerOccupancy();
  return tree;
}

}  // namespace

std::string OccupancyExportOptions::Validate() const {
  return max_ray_m > 0.0 && max_ray_m <= 1000.0 ? "" : "occupancy.max_ray_m: must be in (0, 1000]";
}

void WriteOt(const SurfelMap& map, const OccupancyExportOptions& options, std::ostream& out) {
  octomap::OcTree tree = ToOccupancy(map, options);
  tree.prune();
  tree.write(out);
}

void WriteBt(const SurfelMap& map, const OccupancyExportOptions& options, std::ostream& out) {
  octomap::OcTree tree = ToOccupancy(map, options);
  tree.toMaxLikelihood();
  tree.prune();
  // As tree.writeBinary() does, but for the line that Debian's build of it prints.
  out << "# Octomap OcTree binary file\nid " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
      << tree.getResolution() << "\ndata\n";
  tree.writeBinaryData(out);
}

}  // namespace lcmslam::octo3d
