#include "evaluator/report/quality_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "evaluator/report/episode_statistics.h"
#include "evaluator/report/numbers.h"
#include "geometry/angles.h"

namespace lcmslam::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A row of MotionTable: two figures of a run, NaN where it does not know them.
struct Motion {
  std::string over;
  std::function<double(const Run&)> translation_m, rotation_rad;
};

std::string StepName(const result::Evaluation::RelativeError& relative) {
  return relative.has_step_s() ? fmt::format("{:g} s", relative.step_s()) : fmt::format("{:g} m", relative.step_m());
}

// The relative error of a run over the step of that name.
const result::PoseError* FindRelative(const Run& run, const std::string& step) {
  for (const auto& relative : run.metrics.relative()) {
    if (StepName(relative) == step && relative.error().translation_m().has_mean()) return &relative.error();
  }
  return nullptr;
}

std::vector<Motion> MotionsOf(const Group& group) {
  std::vector<Motion> motions;
  for (const Episode& episode : group.episodes) {
    for (const auto& [system, run] : episode.runs) {
      for (const auto& relative : run.metrics.relative()) {
        const std::string step = StepName(relative);
        if (std::ranges::find(motions, step, &Motion::over) != motions.end()) continue;
        const auto mean_of = [step](const result::Summary& (result::PoseError::*part)() const) {
          return [step, part](const Run& r) {
            const result::PoseError* error = FindRelative(r, step);
            return error == nullptr ? kNaN : (error->*part)().mean();
          };
        };
        motions.push_back(
            {step, mean_of(&result::PoseError::translation_m), mean_of(&result::PoseError::rotation_rad)});
      }
    }
  }
  motions.push_back(
      {"1 m, drift from first to last pose",
       [](const Run& r) { return r.metrics.has_drift() ? r.metrics.drift().translation_m_per_m() : kNaN; },
       [](const Run& r) { return r.metrics.has_drift() ? r.metrics.drift().rotation_rad_per_m() : kNaN; }});
  motions.push_back({"1 m, KITTI segments",
                     [](const Run& r) {
                       return r.metrics.has_kitti() ? r.metrics.kitti().translation_percent().mean() / 100.0 : kNaN;
                     },
                     [](const Run& r) {
                       return r.metrics.has_kitti() ? DegToRad(r.metrics.kitti().rotation_deg_per_m().mean()) : kNaN;
                     }});
  return motions;
}

double SurfaceErrorM(const Run& run, double (result::Summary::*figure)() const) {
  const result::Summary& error = run.map_quality.surface_error_m();
  return error.has_mean() ? (error.*figure)() : kNaN;
}

double ShareWithin(const Run& run, double within_m) {
  for (const auto& completeness : run.map_quality.completeness()) {
    if (completeness.within_m() == within_m) return completeness.share();
  }
  return kNaN;
}

double WallThicknessM(const Run& run) {
  const result::Summary& thickness = run.map_quality.wall_thickness_m();
  return thickness.has_median() ? thickness.median() : kNaN;
}

}  // namespace

Table MotionTable(const Group& group) {
  Table table{"motion",
              "Relative errors: of the motion over each step of time or way, mean over the poses of an episode, median "
              "over episodes. KITTI's percentage (segments of 100 to 800 m) is a tenth of the mm over 1 m.",
              {"system", "over", "translation [mm]", "rotation [mrad]", "rotation [deg]"},
              {},
              2};
  for (const std::string& system : group.systems) {
    for (const Motion& motion : MotionsOf(group)) {
      const double translation_m = MedianOver(group, system, motion.translation_m);
      const double rotation_rad = MedianOver(group, system, motion.rotation_rad);
      if (std::isnan(translation_m)) continue;
      table.rows.push_back(
          {system, motion.over, Millimetres(translation_m), Milliradians(rotation_rad), Degrees(rotation_rad)});
    }
  }
  return table;
}

Table MapTable(const Group& group) {
  constexpr double kWithin_m[] = {0.02, 0.05, 0.10};
  Table table{
      "maps",
      "Maps, median over episodes. Surface error: from the mapped surface to the true one, the map moved by the "
      "alignment of its trajectory. Complete: share of the true surface that has a mapped one within 2, 5, 10 "
      "cm. Wall: standard deviation across the walls that the scans draw when placed by the estimate.",
      {"system", "surface mean [mm]", "surface p95 [mm]", "complete 2 cm [%]", "5 cm [%]", "10 cm [%]", "wall [mm]"},
      {},
      1};
  for (const std::string& system : group.systems) {
    const auto median = [&](const std::function<double(const Run&)>& value) {
      return MedianOver(group, system, value);
    };
    const double mean_m = median([](const Run& r) { return SurfaceErrorM(r, &result::Summary::mean); });
    const double p95_m = median([](const Run& r) { return SurfaceErrorM(r, &result::Summary::p95); });
    const double wall_m = median(WallThicknessM);
    if (std::isnan(mean_m) && std::isnan(wall_m)) continue;
    std::vector<std::string> row = {system, Millimetres(mean_m), Millimetres(p95_m)};
    for (const double within_m : kWithin_m) {
      row.push_back(Percent(median([&](const Run& r) { return ShareWithin(r, within_m); })));
    }
    row.push_back(Millimetres(wall_m));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace lcmslam::report
