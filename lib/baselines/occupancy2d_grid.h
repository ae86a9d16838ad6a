#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lidar/occupancy_grid.h"

namespace lcmslam::occupancy2d {

// A cell of a grid. Its centre is at (x, y) * cell_m in the map frame.
struct GridCell {
  int x = 0;
  int y = 0;
  bool operator==(const GridCell&) const = default;
};

// Visits the cells of Bresenham's line (1965) from `from` up to, but not including, `to`.
template <typename Visit>
void VisitLine(const GridCell& from, const GridCell& to, Visit visit) {
  const int width = std::abs(to.x - from.x), height = std::abs(to.y - from.y);
  const int step_x = from.x < to.x ? 1 : -1, step_y = from.y < to.y ? 1 : -1;
  const bool steep = height > width;
  const int length = steep ? height : width, rise = steep ? width : height;
  const GridCell along = steep ? GridCell{0, step_y} : GridCell{step_x, 0};
  const GridCell aside = steep ? GridCell{step_x, 0} : GridCell{0, step_y};
  GridCell cell = from;
  int error = length / 2;
  for (int i = 0; i < length; ++i) {
    visit(cell);
    cell.x += along.x, cell.y += along.y;
    error -= rise;
    if (error < 0) cell.x += aside.x, cell.y += aside.y, error += length;
  }
}

// One level of the map: log odds that a cell is occupied (Elfes 1989), 0 where nothing was seen. A dense rectangle that
// grows with what is written, 12 bytes a cell. Threads: const members may run side by side.
class LogOddsGrid {
 public:
  struct Options {
    double cell_m = 0.025;
    double probability_free = 0.4;      // of being occupied, for a cell that one beam crossed; 0..0.5
    double probability_occupied = 0.9;  // for a cell that one beam ended in; 0.5..1
    double max_extent_m = 100.0;        // points with a larger |x| or |y| are neither written nor known

    std::string Validate() const;  // "" or "field: reason"
  };
  explicit LogOddsGrid(const Options& options);

  // Writes one scan: where the sensor was and where its beams ended, in the map frame. Each cell changes at most once a
  // scan, and occupied beats free. Beams that start or end beyond max_extent_m or are not finite are left out.
  void Insert(const Eigen::Vector2d& sensor_map, std::span<const Eigen::Vector2d> p_map);

  // M(p): the probability that p is occupied, bilinear between cell centres; 0.5 where unknown or not finite.
  struct Sample {
    double probability = 0.5;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  // 1/m
  };
  enum class Gradient {
    kExact,
    kReleased,  // Hector SLAM's, in which the interpolation weights of x and y are swapped
  };
  Sample At(const Eigen::Vector2d& p_map, Gradient gradient) const;

  double LogOdds(const GridCell& cell) const;
  GridCell CellOf(const Eigen::Vector2d& p_map) const;  // p finite and within max_extent_m
  const Options& options() const { return options_; }

  // The smallest grid that holds every cell seen.
  OccupancyGrid ToOccupancyGrid() const;

 private:
  struct Cell {
    float log_odds = 0.0F;
    uint32_t last_scan = 0;  // that changed it; 0: none
  };

  bool Holds(const Eigen::Vector2d& p_map) const;
  void GrowToHold(const GridCell& low, const GridCell& high);
  void AddOncePerScan(const GridCell& cell, float log_odds);
  size_t Index(const GridCell& cell) const { return static_cast<size_t>(cell.y - low_.y) * width_ + (cell.x - low_.x); }

  Options options_;
  double cells_per_m_;
  float log_odds_free_;
  float log_odds_occupied_;
  uint32_t scan_ = 0;
  GridCell seen_low_, seen_high_;  // the corner cells of what was seen
  GridCell low_;                   // the corner of the rectangle
  int width_ = 0;
  int height_ = 0;
  std::vector<Cell> cells_;         // row by row
  std::vector<float> probability_;  // of cells_; apart, for the cache's sake
};

inline LogOddsGrid::Sample LogOddsGrid::At(const Eigen::Vector2d& p_map, Gradient gradient) const {
  const double x = p_map.x() * cells_per_m_ - low_.x, y = p_map.y() * cells_per_m_ - low_.y;
  if (!(x >= 0.0 && y >= 0.0 && x < width_ - 1 && y < height_ - 1)) return {};
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double u = x - column, v = y - row;
  const float* low = &probability_[static_cast<size_t>(row) * width_ + column];
  const float* high = low + width_;
  const double m00 = low[0], m10 = low[1], m01 = high[0], m11 = high[1];
  const double along_low = m10 - m00, along_high = m11 - m01;
  const double value_low = m00 + u * along_low, value_high = m01 + u * along_high;
  const double weight_x = gradient == Gradient::kExact ? v : u;
  const double weight_y = gradient == Gradient::kExact ? u : v;
  return {value_low + v * (value_high - value_low),
          {cells_per_m_ * (along_low + weight_x * (along_high - along_low)),
           cells_per_m_ * ((m01 - m00) + weight_y * ((m11 - m10) - (m01 - m00)))}};
}

}  // namespace lcmslam::occupancy2d
