#include "baselines/occupancy2d_grid.h"

#include <algorithm>

namespace lcmslam::occupancy2d {
namespace {

constexpr float kMaxLogOdds = 50.0F;
constexpr int kMargin = 64;  // cells added at a side that grows, so that it does not grow with every scan

float LogOddsOf(double probability) { return static_cast<float>(std::log(probability / (1.0 - probability))); }

GridCell Min(const GridCell& a, const GridCell& b) { return {std::min(a.x, b.x), std::min(a.y, b.y)}; }
GridCell Max(const GridCell& a, const GridCell& b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }

}  // namespace

std::string LogOddsGrid::Options::Validate() const {
  constexpr double kMaxCells = 10'000.0;  // from the origin to a side: all within int, and about 5 GB
  if (!(cell_m > 0.0) || !std::isfinite(cell_m)) return "cell_m: must be positive";
  if (!(probability_free > 0.0 && probability_free < 0.5)) return "probability_free: must be in (0, 0.5)";
  if (!(probability_occupied > 0.5 && probability_occupied < 1.0)) return "probability_occupied: must be in (0.5, 1)";
  if (!(max_extent_m >= cell_m)) return "max_extent_m: must be at least cell_m";
  if (!(max_extent_m <= kMaxCells * cell_m)) return "max_extent_m: must be at most 10000 cells";
  return "";
}

LogOddsGrid::LogOddsGrid(const Options& options)
    : options_(options),
      cells_per_m_(1.0 / options.cell_m),
      log_odds_free_(LogOddsOf(options.probability_free)),
      log_odds_occupied_(LogOddsOf(options.probability_occupied)) {}

void LogOddsGrid::Insert(const Eigen::Vector2d& sensor_map, std::span<const Eigen::Vector2d> p_map) {
  if (!Holds(sensor_map)) return;
  const GridCell sensor = CellOf(sensor_map);
  GridCell low = sensor, high = sensor;
  std::vector<GridCell> ends;
  ends.reserve(p_map.size());
  for (const Eigen::Vector2d& p : p_map) {
    if (!Holds(p)) continue;
    ends.push_back(CellOf(p));
    low = Min(low, ends.back()), high = Max(high, ends.back());
  }
  if (ends.empty()) return;
  GrowToHold(low, high);
  seen_low_ = scan_ == 0 ? low : Min(seen_low_, low);
  seen_high_ = scan_ == 0 ? high : Max(seen_high_, high);
  ++scan_;
  // Ends first: then no beam of this scan can clear them.
  for (const GridCell& end : ends) AddOncePerScan(end, log_odds_occupied_);
  for (const GridCell& end : ends) {
    VisitLine(sensor, end, [this](const GridCell& cell) { AddOncePerScan(cell, log_odds_free_); });
  }
}

double LogOddsGrid::LogOdds(const GridCell& cell) const {
  const bool inside = cell.x >= low_.x && cell.y >= low_.y && cell.x - low_.x < width_ && cell.y - low_.y < height_;
  return inside ? cells_[Index(cell)].log_odds : 0.0;
}

GridCell LogOddsGrid::CellOf(const Eigen::Vector2d& p_map) const {
  return {static_cast<int>(std::floor(p_map.x() * cells_per_m_ + 0.5)),
          static_cast<int>(std::floor(p_map.y() * cells_per_m_ + 0.5))};
}

OccupancyGrid LogOddsGrid::ToOccupancyGrid() const {
  OccupancyGrid grid;
  grid.cell_m = options_.cell_m;
  if (cells_.empty()) return grid;
  grid.origin_m = Eigen::Vector2d(seen_low_.x - 0.5, seen_low_.y - 0.5) * options_.cell_m;
  grid.width = seen_high_.x - seen_low_.x + 1;
  grid.height = seen_high_.y - seen_low_.y + 1;
  grid.cells.resize(static_cast<size_t>(grid.width) * grid.height);
  auto drawn = grid.cells.begin();
  for (int y = seen_low_.y; y <= seen_high_.y; ++y) {
    const Cell* row = &cells_[Index({seen_low_.x, y})];
    drawn = std::transform(row, row + grid.width, drawn, [](const Cell& cell) {
      return cell.last_scan == 0 ? int8_t{0} : QuantizeLogOdds(cell.log_odds);
    });
  }
  return grid;
}

// Also false for NaN.
bool LogOddsGrid::Holds(const Eigen::Vector2d& p_map) const {
  return std::abs(p_map.x()) <= options_.max_extent_m && std::abs(p_map.y()) <= options_.max_extent_m;
}

void LogOddsGrid::GrowToHold(const GridCell& low, const GridCell& high) {
  if (cells_.empty()) low_ = low;
  const GridCell old_low = low_, old_end{low_.x + width_, low_.y + height_};
  GridCell end = old_end;
  if (low.x < low_.x) low_.x = low.x - kMargin;
  if (low.y < low_.y) low_.y = low.y - kMargin;
  if (high.x >= end.x) end.x = high.x + 1 + kMargin;
  if (high.y >= end.y) end.y = high.y + 1 + kMargin;
  if (low_ == old_low && end == old_end) return;

  const std::vector<Cell> old_cells = std::move(cells_);
  const std::vector<float> old_probability = std::move(probability_);
  const int old_width = width_;
  width_ = end.x - low_.x, height_ = end.y - low_.y;
  cells_.assign(static_cast<size_t>(width_) * height_, {});
  probability_.assign(cells_.size(), 0.5F);
  for (size_t from = 0; from < old_cells.size(); from += old_width) {
    const size_t to = Index({old_low.x, old_low.y + static_cast<int>(from / old_width)});
    std::copy_n(old_cells.begin() + from, old_width, cells_.begin() + to);
    std::copy_n(old_probability.begin() + from, old_width, probability_.begin() + to);
  }
}

void LogOddsGrid::AddOncePerScan(const GridCell& at, float log_odds) {
  const size_t i = Index(at);
  Cell& cell = cells_[i];
  if (cell.last_scan == scan_) return;
  cell.last_scan = scan_;
  cell.log_odds = std::clamp(cell.log_odds + log_odds, -kMaxLogOdds, kMaxLogOdds);
  probability_[i] = 1.0F / (1.0F + std::exp(-cell.log_odds));
}

}  // namespace lcmslam::occupancy2d
