#pragma once

#include <vector>

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

#include "simulation/planar_world.h"
#include "simulation/random.h"

namespace lcmslam {

// The largest connected region of a world in which a disc keeps its clearance, as cells of a grid. Metres, world frame.
class PlanarFreeSpace {
 public:
  // Every point of the region is at least clearance_m from walls and barriers.
  PlanarFreeSpace(const PlanarWorld& world, double clearance_m);

  bool empty() const { return places_.empty(); }
  bool Contains(const Eigen::Vector2d& p) const;
  // Not empty() only.
  Eigen::Vector2d RandomPlace(Rng& rng) const;

  // The way to one goal from everywhere in a free space, which must outlive it.
  class Guide {
   public:
    Guide(const PlanarFreeSpace& space, const Eigen::Vector2d& goal);
    // A point on the way from `p` such that the straight line to it is free; beyond the next cell only as far as
    // reach_m and while that line has a little room on both sides. `p` itself outside the region.
    Eigen::Vector2d Ahead(const Eigen::Vector2d& p, double reach_m) const;

   private:
    const PlanarFreeSpace& space_;
    std::vector<int> next_;  // by cell: the neighbour on the way, itself at the goal, -1 outside the region
  };

 private:
  struct Neighbour {
    int cell;
    double distance_m;
  };
  int CellAt(const Eigen::Vector2d& p) const;  // -1 outside the grid
  Eigen::Vector2d Center(int cell) const;
  bool IsFree(int cell) const { return slack_m_[static_cast<size_t>(cell)] >= 0.0; }
  boost::container::static_vector<Neighbour, 8> FreeNeighbours(int cell) const;
  bool LineOfSight(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  void KeepLargestRegion();

  Eigen::Vector2d origin_;
  double cell_m_;
  int width_;
  int height_;
  std::vector<double> slack_m_;  // by cell: distance to the nearest obstacle beyond the clearance; negative: not free
  std::vector<int> places_;      // the free cells
};

}  // namespace lcmslam
