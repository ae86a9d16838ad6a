#include "evaluator/report/section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "evaluator/report/curves.h"
#include "evaluator/report/encodings.h"
#include "evaluator/report/figures.h"
#include "evaluator/report/map_image.h"
#include "evaluator/report/quality_tables.h"
#include "evaluator/report/speed_table.h"
#include "evaluator/report/study_tables.h"

namespace lcmslam::report {
namespace {

// The episode in the middle of the first system's ranking, and the worst one of every system.
std::vector<size_t> ChooseEpisodes(const Group& group) {
  std::vector<size_t> chosen;
  const auto choose = [&](size_t i) {
    if (std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
  };
  for (const std::string& system : group.systems) {
    const std::vector<double> errors = TranslationErrors(group, system);
    std::vector<size_t> order(errors.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](size_t i) { return errors[i]; });
    if (chosen.empty()) choose(order[(order.size() - 1) / 2]);
    choose(order.back());
  }
  return chosen;
}

std::string MapFigure(const std::string& system, const std::filesystem::path& map) {
  const MapImage image = LoadMapImage(map);
  if (image.png.empty()) return "";
  std::string size = fmt::format("{} x {} pixels", image.width, image.height);
  if (image.resolution_m > 0.0) {
    size = fmt::format("{:.2f} x {:.2f} m, {:g} m a cell", image.width * image.resolution_m,
                       image.height * image.resolution_m, image.resolution_m);
  }
  return fmt::format(
      "<figure><img alt=\"Map of {0}\" src=\"data:image/png;base64,{1}\">"
      "<figcaption>Map of {0}, {2}, in its own frame</figcaption></figure>\n",
      EscapeHtml(system), Base64(image.png), size);
}

std::string HowItWasMade(const Episode& episode) {
  for (const auto& [system, run] : episode.runs) {
    const result::Evaluation& m = run.metrics;
    if (m.has_absolute()) {
      return fmt::format("alignment {}, {} poses matched, coverage {:.1f} %", m.alignment().kind(),
                         m.association().matched(), 100.0 * m.association().coverage());
    }
  }
  return "no reference";
}

Showcase MakeShowcase(const Group& group, const Episode& episode, const EpisodeCurves& curves,
                      const std::string& name) {
  Showcase showcase;
  const std::string how = HowItWasMade(episode);
  const std::string what = curves.reference.empty() ? "Trajectories" : "Trajectories over the reference";
  if (!curves.systems.empty()) {
    showcase.figures.push_back(
        TrajectoryPlot(name + "_trajectory", fmt::format("{} [m]; {}", what, how), group.systems, curves));
  }
  if (!curves.reference.empty() && !curves.systems.empty()) {
    showcase.figures.push_back(
        ErrorOverTime(name + "_error", fmt::format("Position error over time [mm]; {}", how), group.systems, curves));
  }
  for (const std::string& system : group.systems) {
    const std::filesystem::path& map = episode.runs.at(system).map;
    if (!map.empty()) showcase.map_figures.push_back(MapFigure(system, map));
  }
  return showcase;
}

// Errors of all poses of all episodes, by system.
struct PooledErrors {
  Samples values_m;
  explicit PooledErrors(size_t systems) : values_m(systems) {}
  void Add(const Group& group, const EpisodeCurves& curves) {
    for (size_t i = 0; i < group.systems.size(); ++i) {
      const auto curve = curves.systems.find(group.systems[i]);
      if (curve == curves.systems.end()) continue;
      values_m[i].insert(values_m[i].end(), curve->second.error_m.begin(), curve->second.error_m.end());
    }
  }
  bool IsEmpty() const {
    return std::ranges::all_of(values_m, [](const auto& values) { return values.empty(); });
  }
};

void AddSummary(const Group& group, Section& section) {
  const std::vector<Comparison> comparisons = CompareSystems(group);
  section.verdicts = Verdicts(group, comparisons);
  if (group.episodes.size() == 1) {
    section.tables.push_back(PoseErrorTable(group, group.episodes.front()));
  } else {
    section.tables.push_back(SystemsTable(group));
  }
  if (!comparisons.empty()) {
    section.tables.push_back(RatioTable(group));
    section.tables.push_back(ComparisonTable(comparisons));
  }
  if (group.episodes.size() > 1) section.tables.push_back(MotionTable(group));
  section.tables.push_back(MapTable(group));
  section.tables.push_back(group.episodes.size() == 1 ? TimingTable(group, group.episodes.front()) : SpeedTable(group));
  std::erase_if(section.tables, [](const Table& table) { return table.rows.empty(); });
}

Figure PoseBoxes(const std::string& name, const Group& group, const PooledErrors& pooled) {
  return BoxPlot(name, "Position error of all poses [mm]: median, quartiles, 95 % of the poses within the whiskers",
                 "position error [mm]", group.systems, pooled.values_m);
}

Figure EpisodeBoxes(const std::string& name, const Group& group) {
  Samples errors_m;
  for (const std::string& system : group.systems) errors_m.push_back(TranslationErrors(group, system));
  const std::string caption = fmt::format(
      "Mean position error of {} episodes [mm]: median, quartiles, 95 % of the episodes within the whiskers (of 5 or "
      "more); every episode is a point; failed ones are not drawn",
      group.episodes.size());
  return BoxPlot(name, caption, "mean position error [mm]", group.systems, errors_m);
}

void AddFigures(const Group& group, const PooledErrors& pooled, const std::string& name, Section& section) {
  const bool is_single = group.episodes.size() == 1;
  if (!is_single) section.figures.push_back(EpisodeBoxes(name + "_boxes", group));
  if (is_single && !pooled.IsEmpty()) section.figures.push_back(PoseBoxes(name + "_boxes", group, pooled));
  if (!pooled.IsEmpty()) {
    section.figures.push_back(
        Histogram(name + "_histogram",
                  is_single ? "Position error of all poses [mm]" : "Position error of all poses of all episodes [mm]",
                  group.systems, pooled.values_m));
  }
  Figure timing =
      TimingPlot(name + "_timing",
                 "Time of a scan, wall clock [ms]: dot median, thick line up to p95, thin line up to the largest. "
                 "Ring: latency from arrival to the end of handling, median, line up to the largest p99 of a second",
                 group);
  if (!timing.script.empty()) section.figures.push_back(std::move(timing));
}

}  // namespace

Section MakeSection(const Group& group, const std::string& name) {
  Section section;
  section.heading = group.episodes.size() == 1 ? group.episodes.front().name
                                               : fmt::format("{}: {} episodes", group.name, group.episodes.size());
  AddSummary(group, section);
  const std::vector<size_t> chosen = ChooseEpisodes(group);
  PooledErrors pooled(group.systems.size());
  for (size_t i = 0; i < group.episodes.size(); ++i) {
    const EpisodeCurves curves = LoadCurves(group.episodes[i]);
    pooled.Add(group, curves);
    const auto rank = std::ranges::find(chosen, i);
    if (rank == chosen.end()) continue;
    const std::string showcase_name = fmt::format("{}_episode{}", name, rank - chosen.begin() + 1);
    section.showcases.push_back(MakeShowcase(group, group.episodes[i], curves, showcase_name));
    if (group.episodes.size() > 1) section.showcases.back().heading = group.episodes[i].name;
  }
  AddFigures(group, pooled, name, section);
  section.episodes = EpisodesTable(group);
  return section;
}

}  // namespace lcmslam::report
