#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <octomap/AbstractOcTree.h>
#include <octomap/OcTreeBaseImpl.h>
#include <octomap/OcTreeDataNode.h>

#include "octo3d/point_statistics.h"

// Internal to SurfelMap: OctoMap's octree with surfels for payload. Kept out of public headers (compile time).
namespace lcmslam::octo3d {

// The plane last fitted to a cell. Map frame, metres.
struct CellPlane {
  // What Find() reads comes first, to share a cache line.
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  float height_var = 0.0F;  // of the plane at its mean; at distance d: height_var (1 + d^2 per_extent)
  float per_extent = 0.0F;  // 1 / the smaller variance along the plane
  bool planar = false;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float thickness_var = 0.0F;  // variance across the plane
  float count = 0.0F;          // points at the last fit; 0: never fitted
  uint32_t revision = 0;       // of the map at the last fit

  bool operator==(const CellPlane&) const = default;
};

struct SurfelCell {
  CellPlane plane;
  PointStatistics statistics;  // about the cell's centre
  uint32_t revision = 0;       // of the map when it last changed
  uint32_t viewpoint = 0;      // index of the last viewpoint that saw it (leaves)

  bool operator==(const SurfelCell&) const = default;
};

class SurfelNode : public octomap::OcTreeDataNode<SurfelCell> {
 public:
  SurfelCell& cell() { return value; }
  const SurfelCell& cell() const { return value; }
  bool HasChildren() const { return children != nullptr; }
  SurfelNode* Child(unsigned index) const {
    return children == nullptr ? nullptr : static_cast<SurfelNode*>(children[index]);
  }
};

// Not by way of octomap::OcTreeBase: its constructor is not C++20.
class SurfelOctree : public octomap::OcTreeBaseImpl<SurfelNode, octomap::AbstractOcTree> {
 public:
  explicit SurfelOctree(double leaf_m) : OcTreeBaseImpl(leaf_m) {}
  SurfelOctree* create() const override { return new SurfelOctree(resolution); }

  // The root, made when the tree is empty.
  SurfelNode* Root() {
    if (root == nullptr) {
      root = new SurfelNode();
      ++tree_size;
    }
    return root;
  }
  SurfelNode* ChildOrNew(SurfelNode* node, unsigned index) {
    SurfelNode* child = node->Child(index);
    return child != nullptr ? child : createNodeChild(node, index);
  }
};

}  // namespace lcmslam::octo3d
