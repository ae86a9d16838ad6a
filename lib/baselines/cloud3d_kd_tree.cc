#include "baselines/cloud3d_kd_tree.h"

#include <utility>

#include <nanoflann.hpp>

namespace lcmslam::cloud3d {
namespace {

constexpr size_t kLeafSize = 10;

// nanoflann's view of the points.
struct PointSet {
  std::vector<Eigen::Vector3f> points;

  size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// nanoflann's result set: the nearest few within a distance, sorted.
class NearestWithin {
 public:
  NearestWithin(float max_distance_m2, std::span<Neighbour> found) : max_distance_m2_(max_distance_m2), found_(found) {}

  bool addPoint(float distance_m2, uint32_t index) {
    if (full() && distance_m2 >= found_.back().distance_m2) return true;
    size_t at = full() ? size_ - 1 : size_++;
    for (; at > 0 && found_[at - 1].distance_m2 > distance_m2; --at) found_[at] = found_[at - 1];
    found_[at] = {index, distance_m2};
    return true;
  }
  float worstDist() const { return full() ? found_.back().distance_m2 : max_distance_m2_; }
  bool full() const { return size_ == found_.size(); }
  size_t size() const { return size_; }

 private:
  float max_distance_m2_;
  std::span<Neighbour> found_;
  size_t size_ = 0;
};

}  // namespace

struct KdTree::Index {
  using Metric = nanoflann::L2_Simple_Adaptor<float, PointSet>;

  explicit Index(std::vector<Eigen::Vector3f> points)
      : set{std::move(points)}, tree(3, set, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

  PointSet set;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, PointSet, 3, uint32_t> tree;
};

KdTree::KdTree() : KdTree(std::vector<Eigen::Vector3f>()) {}
KdTree::KdTree(std::vector<Eigen::Vector3f> points) : index_(std::make_unique<Index>(std::move(points))) {}
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;
KdTree::~KdTree() = default;

int KdTree::Nearest(const Eigen::Vector3f& p, float max_distance_m, float epsilon, std::span<Neighbour> found) const {
  if (found.empty() || points().empty()) return 0;
  NearestWithin nearest(max_distance_m * max_distance_m, found);
  const float epsilon_m2 = epsilon * (2.0F + epsilon);  // nanoflann compares squares
  index_->tree.findNeighbors(nearest, p.data(), nanoflann::SearchParams(0, epsilon_m2));
  return static_cast<int>(nearest.size());
}

const std::vector<Eigen::Vector3f>& KdTree::points() const { return index_->set.points; }

}  // namespace lcmslam::cloud3d
