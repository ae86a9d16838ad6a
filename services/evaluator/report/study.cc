#include "evaluator/report/study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "bus/errors.h"
#include "evaluator/result.h"

namespace lcmslam::report {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMetricsSuffix = "_metrics.json";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void FailInput(const std::string& line) { throw CommandError(ExitCode::kBadInput, line); }

fs::path IfThere(const fs::path& path) { return fs::is_regular_file(path) ? path : fs::path(); }

std::vector<fs::path> SortedEntries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder, error)) entries.push_back(entry.path());
  if (error) FailInput(fmt::format("{}: {}", folder.string(), error.message()));
  std::ranges::sort(entries);
  return entries;
}

// "" for other files.
std::string SystemOfMetrics(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(kMetricsSuffix) ? name.substr(0, name.size() - kMetricsSuffix.size()) : "";
}

// What the recording tools call it, in order of preference.
fs::path FindReference(const fs::path& folder) {
  for (const char* name : {"reference_tum.txt", "ground_truth_tum.txt", "ground_truth_000_tum.txt"}) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  return {};
}

// No runs when the folder is no episode.
Episode ReadEpisode(const fs::path& folder, const std::string& name) {
  Episode episode{.name = name,
                  .folder = folder,
                  .reference = FindReference(folder),
                  .bound_file = IfThere(folder / "bound.csv"),
                  .bound = {},
                  .runs = {}};
  if (!episode.bound_file.empty()) episode.bound = ReadBound(episode.bound_file);
  for (const fs::path& path : SortedEntries(folder)) {
    const std::string system = SystemOfMetrics(path);
    if (system.empty()) continue;
    Run& run = episode.runs[system];
    run.has_metrics = true;
    ReadJson(path, run.metrics);
    run.metrics_file = path;
  }
  return episode;
}

void CollectEpisodes(const fs::path& folder, const std::string& name, std::vector<Episode>& episodes) {
  Episode episode = ReadEpisode(folder, name);
  if (!episode.runs.empty()) {
    episodes.push_back(std::move(episode));
    return;
  }
  for (const fs::path& path : SortedEntries(folder)) {
    if (!fs::is_directory(path) || fs::is_symlink(path)) continue;  // `latest` points to one of the others
    const std::string file_name = path.filename().string();
    CollectEpisodes(path, name.empty() ? file_name : name + "/" + file_name, episodes);
  }
}

std::string NameOf(const fs::path& folder) {
  const fs::path normal = fs::weakly_canonical(folder);
  return normal.filename().string();
}

std::vector<Group> ReadGroups(const std::vector<fs::path>& folders) {
  Group singles{.name = folders.size() == 1 ? "Run" : "Runs", .systems = {}, .episodes = {}};
  std::vector<Group> groups;
  for (const fs::path& folder : folders) {
    Episode single = ReadEpisode(folder, NameOf(folder));
    if (!single.runs.empty()) {
      singles.episodes.push_back(std::move(single));
      continue;
    }
    Group group{.name = NameOf(folder), .systems = {}, .episodes = {}};
    CollectEpisodes(folder, "", group.episodes);
    if (group.episodes.empty()) FailInput(fmt::format("{}: no *{} in it or below", folder.string(), kMetricsSuffix));
    groups.push_back(std::move(group));
  }
  if (!singles.episodes.empty()) groups.insert(groups.begin(), std::move(singles));
  return groups;
}

// Our systems first, each before its baseline.
std::vector<std::string> Ordered(const std::set<std::string>& systems) {
  constexpr std::array<std::string_view, 4> kFirst = {"sdf2d-slam", "occupancy2d-slam", "octo3d-slam", "cloud3d-slam"};
  std::vector<std::string> ordered(systems.begin(), systems.end());
  std::ranges::stable_sort(
      ordered, {}, [&](const std::string& system) { return std::ranges::find(kFirst, system) - kFirst.begin(); });
  return ordered;
}

std::set<std::string> SystemsOf(const Episode& episode) {
  std::set<std::string> systems;
  for (const auto& [system, run] : episode.runs) systems.insert(system);
  return systems;
}

// The systems that met in an episode, or met the same others.
std::vector<std::set<std::string>> Met(const std::vector<Episode>& episodes) {
  std::vector<std::set<std::string>> met;
  for (const Episode& episode : episodes) {
    std::set<std::string> systems = SystemsOf(episode);
    std::erase_if(met, [&](const std::set<std::string>& others) {
      const bool meet = std::ranges::any_of(others, [&](const std::string& other) { return systems.contains(other); });
      if (meet) systems.insert(others.begin(), others.end());
      return meet;
    });
    met.push_back(std::move(systems));
  }
  return met;
}

void AddSplit(const Group& group, std::vector<Group>& groups) {
  const std::vector<std::set<std::string>> all = Met(group.episodes);
  for (const std::set<std::string>& met : all) {
    Group part{.name = group.name, .systems = Ordered(met), .episodes = {}};
    if (all.size() > 1) part.name += fmt::format(": {}", fmt::join(part.systems, ", "));
    std::ranges::copy_if(group.episodes, std::back_inserter(part.episodes),
                         [&](const Episode& episode) { return met.contains(episode.runs.begin()->first); });
    groups.push_back(std::move(part));
  }
}

std::string WhyFailed(const Run& run, const FailureRule& rule) {
  if (!run.has_metrics) return "no result";
  const double mean_m = ErrorOf(run).translation_m().has_mean() ? ErrorOf(run).translation_m().mean() : kInfinity;
  if (!std::isfinite(mean_m)) return "nothing matched";
  if (mean_m > rule.max_mean_m) return fmt::format("mean error {:.3f} m", mean_m);
  const auto& association = run.metrics.association();
  if (run.metrics.has_absolute() && association.coverage() < rule.min_coverage) {
    return fmt::format("coverage {:.1f} %", 100.0 * association.coverage());
  }
  return "";
}

void CompleteRun(const Episode& episode, const std::string& system, const FailureRule& rule, Run& run) {
  run.trajectory = IfThere(episode.folder / (system + "_tum.txt"));
  run.map = IfThere(episode.folder / (system + "_map.pgm"));
  run.config = IfThere(episode.folder / (system + ".pbtxt"));
  run.map_quality_file = IfThere(episode.folder / (system + "_map_quality.json"));
  if (!run.map_quality_file.empty()) ReadJson(run.map_quality_file, run.map_quality);
  run.failure = WhyFailed(run, rule);
}

}  // namespace

std::string FailureRule::Validate() const {
  if (!(max_mean_m > 0.0)) return "--failure: must be positive";
  if (!(min_coverage >= 0.0 && min_coverage <= 1.0)) return "--failure-coverage: must be in 0..1";
  return "";
}

Study LoadStudy(const std::vector<fs::path>& folders, const FailureRule& rule) {
  Study study;
  study.failure_rule = rule;
  for (const Group& group : ReadGroups(folders)) AddSplit(group, study.groups);
  std::set<std::string> systems;
  for (Group& group : study.groups) {
    systems.insert(group.systems.begin(), group.systems.end());
    for (Episode& episode : group.episodes) {
      for (const std::string& system : group.systems) CompleteRun(episode, system, rule, episode.runs[system]);
    }
  }
  study.systems = Ordered(systems);
  return study;
}

const result::PoseError& ErrorOf(const Run& run) {
  return run.metrics.has_absolute() ? run.metrics.absolute() : run.metrics.relations().error();
}

double TranslationError(const Run& run) {
  return run.failure.empty() ? ErrorOf(run).translation_m().mean() : kInfinity;
}

double RotationError(const Run& run) { return run.failure.empty() ? ErrorOf(run).rotation_rad().mean() : kInfinity; }

}  // namespace lcmslam::report
