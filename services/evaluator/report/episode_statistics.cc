#include "evaluator/report/episode_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajectory/summary.h"

namespace lcmslam::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Median and the like where some values are infinite.
double Ranked(const std::vector<double>& sorted, double fraction) {
  if (sorted.empty()) return kNaN;
  const double rank = fraction * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(rank), above = std::min(below + 1, sorted.size() - 1);
  const double weight = rank - static_cast<double>(below);
  if (weight == 0.0 || sorted[below] == sorted[above]) return sorted[below];
  return sorted[below] + weight * (sorted[above] - sorted[below]);
}

template <typename Value>
std::vector<double> OverEpisodes(const Group& group, const std::string& system, Value value) {
  std::vector<double> values;
  for (const Episode& episode : group.episodes) values.push_back(value(episode.runs.at(system)));
  return values;
}

}  // namespace

EpisodeSummary SummarizeEpisodes(std::vector<double> errors) {
  std::ranges::sort(errors);
  const auto failed = std::ranges::find_if(errors, [](double e) { return std::isinf(e); });
  const Summary completed = Summarize({errors.begin(), failed});
  const auto n = static_cast<double>(completed.count);
  EpisodeSummary summary;
  summary.episodes = static_cast<int64_t>(errors.size());
  summary.completed = completed.count;
  summary.mean = completed.mean;
  summary.sd = n > 1 ? completed.sd * std::sqrt(n / (n - 1.0)) : kNaN;
  summary.median = Ranked(errors, 0.5);
  summary.p95 = Ranked(errors, 0.95);
  summary.max = Ranked(errors, 1.0);
  return summary;
}

std::vector<double> TranslationErrors(const Group& group, const std::string& system) {
  return OverEpisodes(group, system, TranslationError);
}

std::vector<double> RotationErrors(const Group& group, const std::string& system) {
  return OverEpisodes(group, system, RotationError);
}

double Coverage(const Run& run) {
  if (run.metrics.has_absolute()) return run.metrics.association().coverage();
  const auto& relations = run.metrics.relations();
  return static_cast<double>(relations.matched()) / static_cast<double>(relations.matched() + relations.unmatched());
}

double MedianOver(const Group& group, const std::string& system, const std::function<double(const Run&)>& value) {
  std::vector<double> values = OverEpisodes(group, system, value);
  std::erase_if(values, [](double v) { return std::isnan(v); });
  return Percentile(values, 0.5);
}

double MedianCoverage(const Group& group, const std::string& system) { return MedianOver(group, system, Coverage); }

double MedianStepMs(const Group& group, const std::string& system, double (result::Summary::*figure)() const) {
  return MedianOver(group, system, [&](const Run& run) {
    return run.metrics.timing().has_step_ms() ? (run.metrics.timing().step_ms().*figure)() : kNaN;
  });
}

double MedianOverBound(const Group& group, const std::string& system, double (result::Summary::*error)() const,
                       double Bound::*bound) {
  std::vector<double> ratios;
  for (const Episode& episode : group.episodes) {
    const Run& run = episode.runs.at(system);
    if (!(episode.bound.*bound > 0.0)) continue;
    ratios.push_back(run.failure.empty() ? (ErrorOf(run).translation_m().*error)() / (episode.bound.*bound)
                                         : std::numeric_limits<double>::infinity());
  }
  std::ranges::sort(ratios);
  return Ranked(ratios, 0.5);
}

}  // namespace lcmslam::report
