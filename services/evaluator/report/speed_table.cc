#include "evaluator/report/speed_table.h"

#include <map>

#include "evaluator/report/numbers.h"
#include "trajectory/summary.h"

namespace lcmslam::report {
namespace {

// One value an episode.
struct StageSamples {
  std::vector<double> median_ms, p95_ms, per_s, iterations, iterations_per_s;
};

// What systems call the stage that iterates.
bool IsRegistration(const std::string& stage) { return stage == "register" || stage == "match" || stage == "icp"; }

void AddSample(const result::Summary& ms, StageSamples& samples) {
  samples.median_ms.push_back(ms.median());
  samples.p95_ms.push_back(ms.p95());
  if (ms.mean() > 0.0) samples.per_s.push_back(1e3 / ms.mean());
}

void AddIterations(const result::Timing& timing, const result::Summary& ms, StageSamples& samples) {
  if (!timing.has_iterations() || !(ms.mean() > 0.0)) return;
  samples.iterations.push_back(timing.iterations().mean());
  samples.iterations_per_s.push_back(1e3 * timing.iterations().mean() / ms.mean());
}

std::string Median(std::vector<double> values) { return values.empty() ? "" : Number(Percentile(values, 0.5)); }

void AddRow(const std::string& system, const std::string& stage, const StageSamples& samples, Table& table) {
  table.rows.push_back({system, stage, Median(samples.median_ms), Median(samples.p95_ms), Median(samples.per_s),
                        Median(samples.iterations), Median(samples.iterations_per_s)});
}

}  // namespace

Table SpeedTable(const Group& group) {
  Table table{"speed",
              "Time of a scan and of its stages, wall clock, and how many fit into a second of it; iterations of a "
              "registration, and how many it does in a second of its own time. Medians over episodes.",
              {"system", "stage", "median [ms]", "p95 [ms]", "1/s", "iterations", "iterations/s"},
              {},
              2};
  for (const std::string& system : group.systems) {
    StageSamples scan;
    std::map<std::string, StageSamples> stages;
    for (const Episode& episode : group.episodes) {
      const result::Timing& timing = episode.runs.at(system).metrics.timing();
      if (!timing.has_step_ms()) continue;
      AddSample(timing.step_ms(), scan);
      for (const auto& stage : timing.stages()) {
        AddSample(stage.ms(), stages[stage.name()]);
        if (IsRegistration(stage.name())) AddIterations(timing, stage.ms(), stages[stage.name()]);
      }
    }
    if (scan.median_ms.empty()) continue;
    AddRow(system, "whole scan", scan, table);
    for (const auto& [stage, samples] : stages) AddRow(system, stage, samples, table);
  }
  return table;
}

}  // namespace lcmslam::report
