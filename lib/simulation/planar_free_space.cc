#include "simulation/planar_free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include <boost/random/uniform_int_distribution.hpp>

namespace lcmslam {
namespace {

using Eigen::Vector2d;

constexpr double kFinestCell_m = 0.05;
constexpr double kMaxCellsPerSide = 1000.0;
constexpr double kSamplesPerCell = 8.0;   // along a line of sight
constexpr double kSightHalfWidth = 0.25;  // of a line of sight, in cells
constexpr double kSlackCap_m = 0.4;       // ways keep this much more than the clearance where there is room
constexpr double kDetourFactor = 10.0;    // how much longer a way may be for having that room

}  // namespace

PlanarFreeSpace::PlanarFreeSpace(const PlanarWorld& world, double clearance_m) {
  const Eigen::AlignedBox2d bounds = world.bounds().isEmpty() ? Eigen::AlignedBox2d(Vector2d::Zero()) : world.bounds();
  const Vector2d extent = bounds.sizes();
  origin_ = bounds.min();
  cell_m_ = std::max(kFinestCell_m, extent.maxCoeff() / kMaxCellsPerSide);
  width_ = static_cast<int>(extent.x() / cell_m_);
  height_ = static_cast<int>(extent.y() / cell_m_);
  // A cell is free when all of it keeps the clearance, not only its centre.
  const double needed_m = clearance_m + 0.5 * std::numbers::sqrt2 * cell_m_;
  for (int cell = 0; cell < width_ * height_; ++cell) {
    slack_m_.push_back(world.Distance(Center(cell), needed_m + kSlackCap_m) - needed_m);
  }
  KeepLargestRegion();
}

bool PlanarFreeSpace::Contains(const Vector2d& p) const {
  const int cell = CellAt(p);
  return cell >= 0 && IsFree(cell);
}

Vector2d PlanarFreeSpace::RandomPlace(Rng& rng) const {
  return Center(places_[boost::random::uniform_int_distribution<size_t>(0, places_.size() - 1)(rng)]);
}

int PlanarFreeSpace::CellAt(const Vector2d& p) const {
  const double ix = std::floor((p.x() - origin_.x()) / cell_m_);
  const double iy = std::floor((p.y() - origin_.y()) / cell_m_);
  if (!(ix >= 0.0 && iy >= 0.0 && ix < width_ && iy < height_)) return -1;
  return static_cast<int>(iy) * width_ + static_cast<int>(ix);
}

Vector2d PlanarFreeSpace::Center(int cell) const {
  const int ix = cell % width_;
  const int iy = cell / width_;
  return origin_ + cell_m_ * Vector2d(ix + 0.5, iy + 0.5);
}

// The eight around the cell; a diagonal only where it cuts no corner.
boost::container::static_vector<PlanarFreeSpace::Neighbour, 8> PlanarFreeSpace::FreeNeighbours(int cell) const {
  const int x = cell % width_;
  const int y = cell / width_;
  const auto is_free = [&](int dx, int dy) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) return false;
    return IsFree(cell + dy * width_ + dx);
  };
  boost::container::static_vector<Neighbour, 8> neighbours;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if ((dx == 0 && dy == 0) || !is_free(dx, dy) || !is_free(dx, 0) || !is_free(0, dy)) continue;
      neighbours.push_back({cell + dy * width_ + dx, cell_m_ * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0)});
    }
  }
  return neighbours;
}

bool PlanarFreeSpace::LineOfSight(const Vector2d& a, const Vector2d& b) const {
  const Vector2d aside = kSightHalfWidth * cell_m_ * (b - a).unitOrthogonal();
  const int samples = 1 + static_cast<int>(kSamplesPerCell * (b - a).norm() / cell_m_);
  for (int i = 0; i <= samples; ++i) {
    const Vector2d p = a + (b - a) * i / samples;
    if (!Contains(p + aside) || !Contains(p - aside)) return false;
  }
  return true;
}

void PlanarFreeSpace::KeepLargestRegion() {
  std::vector<bool> seen(slack_m_.size(), false);
  for (int seed = 0; seed < width_ * height_; ++seed) {
    if (!IsFree(seed) || seen[static_cast<size_t>(seed)]) continue;
    std::vector<int> region{seed};
    seen[static_cast<size_t>(seed)] = true;
    for (size_t i = 0; i < region.size(); ++i) {
      for (const Neighbour& neighbour : FreeNeighbours(region[i])) {
        if (seen[static_cast<size_t>(neighbour.cell)]) continue;
        seen[static_cast<size_t>(neighbour.cell)] = true;
        region.push_back(neighbour.cell);
      }
    }
    if (region.size() > places_.size()) places_ = std::move(region);
  }
  std::vector<double> kept(slack_m_.size(), -1.0);
  for (const int cell : places_) kept[static_cast<size_t>(cell)] = slack_m_[static_cast<size_t>(cell)];
  slack_m_ = std::move(kept);
}

// Dijkstra's algorithm from the goal; steps near obstacles cost more.
PlanarFreeSpace::Guide::Guide(const PlanarFreeSpace& space, const Vector2d& goal)
    : space_(space), next_(space.slack_m_.size(), -1) {
  const int goal_cell = space.CellAt(goal);
  if (goal_cell < 0 || !space.IsFree(goal_cell)) return;
  std::vector<double> cost(space.slack_m_.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto visit = [&](int cell, int next, double new_cost) {
    if (new_cost >= cost[static_cast<size_t>(cell)]) return;
    cost[static_cast<size_t>(cell)] = new_cost;
    next_[static_cast<size_t>(cell)] = next;
    open.emplace(new_cost, cell);
  };
  visit(goal_cell, goal_cell, 0.0);
  while (!open.empty()) {
    const auto [cell_cost, cell] = open.top();
    open.pop();
    if (cell_cost > cost[static_cast<size_t>(cell)]) continue;
    for (const Neighbour& neighbour : space.FreeNeighbours(cell)) {
      const double room = space.slack_m_[static_cast<size_t>(neighbour.cell)] / kSlackCap_m;
      visit(neighbour.cell, cell, cell_cost + neighbour.distance_m * std::pow(kDetourFactor, 1.0 - room));
    }
  }
}

Vector2d PlanarFreeSpace::Guide::Ahead(const Vector2d& p, double reach_m) const {
  const auto next = [this](int cell) { return next_[static_cast<size_t>(cell)]; };
  int cell = space_.CellAt(p);
  if (cell < 0 || next(cell) < 0) return p;
  cell = next(cell);  // always in sight: the two cells, and for a diagonal the two beside them, are free
  while (next(cell) != cell) {
    const Vector2d candidate = space_.Center(next(cell));
    if ((candidate - p).norm() > reach_m || !space_.LineOfSight(p, candidate)) break;
    cell = next(cell);
  }
  return space_.Center(cell);
}

}  // namespace lcmslam
