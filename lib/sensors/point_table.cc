#include "sensors/point_table.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

using Column = std::vector<double>;

constexpr double kLongestSweep_us = 2e9;

// The first of these columns that is there.
const Column* Find(const PointTable& table, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (const auto column = table.columns.find(name); column != table.columns.end()) return &column->second;
  }
  return nullptr;
}

const Column& Need(const PointTable& table, std::string_view name) {
  const Column* column = Find(table, {name});
  if (column == nullptr) throw BadInput(fmt::format("points without {}", name));
  return *column;
}

// Whether something was measured: drivers leave times and rings of other points as they happen to be.
bool IsReturn(double x, double y, double z) {
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && (x != 0.0 || y != 0.0 || z != 0.0);
}
bool IsReturn(const SweepPoint& p) { return IsReturn(p.x, p.y, p.z); }

struct Times {
  const Column* column = nullptr;  // none: unknown
  double us_per_unit = 0.0;
  double latest = 0.0;  // of a return, in units
};

Times FindTimes(const PointTable& table) {
  constexpr double kUsPerNanosecond = 1e-3, kUsPerSecond = 1e6;
  constexpr double kLatest_s = 1e14;  // no seconds since 1970 are more
  const Column* nanoseconds = Find(table, {"t", "offset_time"});
  const Column* column = nanoseconds != nullptr ? nanoseconds : Find(table, {"time", "timestamp"});
  if (column == nullptr) return {};
  const Column &x = Need(table, "x"), &y = Need(table, "y"), &z = Need(table, "z");
  double latest = -std::numeric_limits<double>::infinity();
  bool any_return = false;
  for (size_t i = 0; i < column->size(); ++i) {
    if (!IsReturn(x[i], y[i], z[i])) continue;
    any_return = true;
    latest = std::max(latest, (*column)[i]);
  }
  if (!any_return) return {};
  if (!std::isfinite(latest)) throw BadInput("points with absurd times");
  const bool in_nanoseconds = nanoseconds != nullptr || latest > kLatest_s;
  return {column, in_nanoseconds ? kUsPerNanosecond : kUsPerSecond, latest};
}

void SetTimes(const Times& times, std::vector<SweepPoint>& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (!IsReturn(points[i])) continue;
    const double dt_us = times.us_per_unit * ((*times.column)[i] - times.latest);
    if (!(dt_us >= -kLongestSweep_us)) throw BadInput("points with absurd times");
    points[i].dt_us = static_cast<int32_t>(std::lround(dt_us));
  }
}

void SetRings(const Column& rings, std::vector<SweepPoint>& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (!IsReturn(points[i])) continue;
    const bool fits = rings[i] >= 0.0 && rings[i] <= std::numeric_limits<int16_t>::max();
    if (!fits) throw BadInput(fmt::format("point of ring {}", rings[i]));
    points[i].ring = static_cast<int16_t>(rings[i]);
  }
}

}  // namespace

std::vector<double>& PointTable::AddColumn(const std::string& name) {
  const auto [column, added] = columns.try_emplace(name);
  if (!added) throw BadInput(fmt::format("{} twice", name));
  return column->second;
}

std::vector<SweepPoint> ToSweepPoints(const PointTable& table) {
  const Column &x = Need(table, "x"), &y = Need(table, "y"), &z = Need(table, "z");
  const Column* intensity = Find(table, {"intensity", "i", "reflectivity"});
  std::vector<SweepPoint> points(table.num_points);
  for (size_t i = 0; i < points.size(); ++i) {
    points[i].x = static_cast<float>(x[i]);
    points[i].y = static_cast<float>(y[i]);
    points[i].z = static_cast<float>(z[i]);
    if (intensity != nullptr) points[i].intensity = static_cast<float>((*intensity)[i]);
  }
  if (const Column* rings = Find(table, {"ring", "laser_id"})) SetRings(*rings, points);
  if (const Times times = FindTimes(table); times.column != nullptr) SetTimes(times, points);
  return points;
}

std::optional<double> LatestTime_us(const PointTable& table) {
  const Times times = FindTimes(table);
  if (times.column == nullptr) return std::nullopt;
  return times.us_per_unit * times.latest;
}

}  // namespace lcmslam
