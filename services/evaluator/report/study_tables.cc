#include "evaluator/report/study_tables.h"

#include <fmt/format.h>

#include "evaluator/report/numbers.h"
#include "geometry/angles.h"

namespace lcmslam::report {
namespace {

void AddErrorRow(Table& table, const std::string& system, const std::string& what, const result::PoseError& error) {
  const auto& t = error.translation_m();
  if (!t.has_mean()) return;
  table.rows.push_back({system, what, Millimetres(t.mean()), Millimetres(t.rmse()), Millimetres(t.median()),
                        Millimetres(t.sd()), Millimetres(t.p95()), Millimetres(t.max()),
                        Milliradians(error.rotation_rad().mean()), Degrees(error.rotation_rad().mean()),
                        Milliradians(error.rotation_rad().sd()), Milliradians(error.rotation_rad().max()),
                        std::to_string(t.count())});
}

// Of what has a mean only.
void AddMeanRow(Table& table, const std::string& system, const std::string& what, double mean_m, double mean_rad) {
  table.rows.push_back({system, what, Millimetres(mean_m), "-", "-", "-", "-", "-", Milliradians(mean_rad),
                        Degrees(mean_rad), "-", "-", "-"});
}

void AddRatioRow(Table& table, const std::string& system, const std::string& other, const char* what, double a,
                 double b) {
  table.rows.push_back({what, system, other, Millimetres(a), Millimetres(b), Number(b / a), Percent(1.0 - a / b)});
}

}  // namespace

std::vector<Comparison> CompareSystems(const Group& group) {
  std::vector<Comparison> comparisons;
  if (group.episodes.size() < 2) return comparisons;
  const std::string& system = group.systems.front();
  for (size_t i = 1; i < group.systems.size(); ++i) {
    const std::string& other = group.systems[i];
    comparisons.push_back({system, other, "translation", "mm",
                           ComparePaired(TranslationErrors(group, system), TranslationErrors(group, other))});
    comparisons.push_back({system, other, "rotation", "mrad",
                           ComparePaired(RotationErrors(group, system), RotationErrors(group, other))});
  }
  std::vector<double> p_values;
  for (const Comparison& comparison : comparisons) p_values.push_back(comparison.paired.p);
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  for (size_t i = 0; i < comparisons.size(); ++i) comparisons[i].holm_p = adjusted[i];
  return comparisons;
}

Table SystemsTable(const Group& group) {
  Table table;
  table.name = "systems";
  table.caption = fmt::format(
      "Mean error of each of {} episodes, summed up over episodes. Mean and SD (n - 1) over completed episodes; in "
      "median, p95 and max failed ones rank worst. RMSE / bound: RMSE of an episode over the root mean square of its "
      "scans' Cramer-Rao bounds, median over episodes. Times: of a scan, wall clock, median over episodes.",
      group.episodes.size());
  table.header = {"system",       "completed",    "mean [mm]",   "median [mm]", "SD [mm]",
                  "p95 [mm]",     "max [mm]",     "rot. [mrad]", "rot. [deg]",  "rot. SD [mrad]",
                  "coverage [%]", "RMSE / bound", "median [ms]", "p95 [ms]",    "p99 [ms]"};
  for (const std::string& system : group.systems) {
    const EpisodeSummary s = SummarizeEpisodes(TranslationErrors(group, system));
    const EpisodeSummary r = SummarizeEpisodes(RotationErrors(group, system));
    table.rows.push_back({system, fmt::format("{} of {}", s.completed, s.episodes), Millimetres(s.mean),
                          Millimetres(s.median), Millimetres(s.sd), Millimetres(s.p95), Millimetres(s.max),
                          Milliradians(r.mean), Degrees(r.mean), Milliradians(r.sd),
                          Percent(MedianCoverage(group, system)),
                          Number(MedianOverBound(group, system, &result::Summary::rmse, &Bound::rms_m)),
                          Number(MedianStepMs(group, system, &result::Summary::median)),
                          Number(MedianStepMs(group, system, &result::Summary::p95)),
                          Number(MedianStepMs(group, system, &result::Summary::p99))});
  }
  return table;
}

Table RatioTable(const Group& group) {
  Table table;
  table.name = "ratios";
  table.caption = "Mean error of episodes: a, b, b/a and 1 - a/b. Mean and SD over completed episodes.";
  table.header = {"", "a", "b", "a [mm]", "b [mm]", "b/a", "1 - a/b [%]"};
  table.text_columns = 3;
  const std::string& system = group.systems.front();
  const EpisodeSummary a = SummarizeEpisodes(TranslationErrors(group, system));
  for (size_t i = 1; i < group.systems.size(); ++i) {
    const std::string& other = group.systems[i];
    const EpisodeSummary b = SummarizeEpisodes(TranslationErrors(group, other));
    AddRatioRow(table, system, other, "mean", a.mean, b.mean);
    AddRatioRow(table, system, other, "median", a.median, b.median);
    AddRatioRow(table, system, other, "SD", a.sd, b.sd);
  }
  return table;
}

Table ComparisonTable(const std::vector<Comparison>& comparisons) {
  Table table;
  table.name = "comparisons";
  table.caption =
      "Paired over episodes. Shift: Hodges-Lehmann estimate of a - b, negative where a is better, with a 95 % "
      "bootstrap interval "
      "(2000 resamples, seed 1). p: two-sided Wilcoxon signed-rank test, and after Holm over this table.";
  table.header = {"a",    "b",     "error", "a wins", "b wins", "equal",   "win rate [%]",
                  "unit", "shift", "from",  "to",     "p",      "p (Holm)"};
  table.text_columns = 3;
  for (const Comparison& c : comparisons) {
    const PairedComparison& p = c.paired;
    table.rows.push_back({c.system, c.other, c.error, std::to_string(p.wins_a), std::to_string(p.wins_b),
                          std::to_string(p.ties), Percent(p.win_rate_a()), c.unit, Shift(1e3 * p.shift),
                          Shift(1e3 * p.shift_interval.low), Shift(1e3 * p.shift_interval.high), PValue(p.p),
                          PValue(c.holm_p)});
  }
  return table;
}

Table EpisodesTable(const Group& group) {
  Table table;
  table.name = "episodes";
  table.caption = "Every episode: errors over its poses.";
  table.header = {"episode",  "system",      "mean [mm]",    "RMSE [mm]", "p95 [mm]",
                  "max [mm]", "rot. [mrad]", "coverage [%]", "alignment", "failure"};
  table.text_columns = 2;
  for (const Episode& episode : group.episodes) {
    for (const std::string& system : group.systems) {
      const Run& run = episode.runs.at(system);
      if (!run.has_metrics) {
        table.rows.push_back({episode.name, system, "-", "-", "-", "-", "-", "-", "-", run.failure});
        continue;
      }
      const result::PoseError& error = ErrorOf(run);
      const auto& t = error.translation_m();
      table.rows.push_back({episode.name, system, Millimetres(t.mean()), Millimetres(t.rmse()), Millimetres(t.p95()),
                            Millimetres(t.max()), Milliradians(error.rotation_rad().mean()), Percent(Coverage(run)),
                            run.metrics.has_alignment() ? run.metrics.alignment().kind() : "relations", run.failure});
    }
  }
  return table;
}

Table PoseErrorTable(const Group& group, const Episode& episode) {
  Table table;
  table.name = "errors";
  table.caption =
      "Errors over the poses of the run. SD divides by n. KITTI's percentage (segments of 100 to 800 m) is a tenth of "
      "the "
      "mm per m.";
  table.header = {"system",   "error",       "mean [mm]",  "RMSE [mm]",      "median [mm]",     "SD [mm]", "p95 [mm]",
                  "max [mm]", "rot. [mrad]", "rot. [deg]", "rot. SD [mrad]", "rot. max [mrad]", "n"};
  table.text_columns = 2;
  for (const std::string& system : group.systems) {
    const result::Evaluation& m = episode.runs.at(system).metrics;
    if (m.has_absolute()) AddErrorRow(table, system, "absolute", m.absolute());
    for (const auto& relative : m.relative()) {
      const std::string step =
          relative.has_step_s() ? fmt::format("{} s", relative.step_s()) : fmt::format("{} m", relative.step_m());
      AddErrorRow(table, system, "relative over " + step, relative.error());
    }
    if (m.has_drift()) {
      AddMeanRow(table, system, "drift per m, first to last pose", m.drift().translation_m_per_m(),
                 m.drift().rotation_rad_per_m());
    }
    if (m.has_kitti()) {
      AddMeanRow(table, system, "KITTI segments, per m", m.kitti().translation_percent().mean() / 100.0,
                 DegToRad(m.kitti().rotation_deg_per_m().mean()));
    }
    if (m.has_relations()) AddErrorRow(table, system, "relations", m.relations().error());
  }
  return table;
}

Table TimingTable(const Group& group, const Episode& episode) {
  Table table;
  table.name = "timing";
  table.caption = "Time of a scan, wall clock, and of its stages.";
  table.header = {"system", "stage", "mean [ms]", "median [ms]", "p95 [ms]", "p99 [ms]", "max [ms]", "n"};
  table.text_columns = 2;
  const auto add = [&](const std::string& system, const std::string& stage, const result::Summary& s) {
    table.rows.push_back({system, stage, Number(s.mean()), Number(s.median()), Number(s.p95()), Number(s.p99()),
                          Number(s.max()), std::to_string(s.count())});
  };
  for (const std::string& system : group.systems) {
    const result::Timing& timing = episode.runs.at(system).metrics.timing();
    if (timing.has_step_ms()) add(system, "whole scan", timing.step_ms());
    for (const auto& stage : timing.stages()) add(system, stage.name(), stage.ms());
    if (timing.has_latency_p50_ms()) {
      table.rows.push_back({system, "latency, arrival to end", "-", Number(timing.latency_p50_ms()), "-",
                            Number(timing.latency_p99_ms()), "-", "-"});
    }
  }
  return table;
}

std::vector<std::string> Verdicts(const Group& group, const std::vector<Comparison>& comparisons) {
  std::vector<std::string> verdicts;
  const EpisodeSummary first = SummarizeEpisodes(TranslationErrors(group, group.systems.front()));
  for (const Comparison& c : comparisons) {
    if (c.error != "translation") continue;
    const EpisodeSummary other = SummarizeEpisodes(TranslationErrors(group, c.other));
    const PairedComparison& p = c.paired;
    verdicts.push_back(
        fmt::format("{} against {}: median of the mean errors {} mm against {} mm ({} times as much); smaller in {} of "
                    "{} episodes, "
                    "shift {} mm (95 %: {} to {}), p = {} (Holm).",
                    c.system, c.other, Millimetres(first.median), Millimetres(other.median),
                    Number(other.median / first.median), p.wins_a, p.episodes, Shift(1e3 * p.shift),
                    Shift(1e3 * p.shift_interval.low), Shift(1e3 * p.shift_interval.high), PValue(c.holm_p)));
  }
  if (!comparisons.empty()) return verdicts;
  for (const std::string& system : group.systems) {
    const EpisodeSummary s = SummarizeEpisodes(TranslationErrors(group, system));
    verdicts.push_back(fmt::format("{}: mean error {} mm.", system, Millimetres(s.median)));
  }
  return verdicts;
}

}  // namespace lcmslam::report
