#pragma once

#include <string>
#include <vector>

#include "evaluator/report/episode_statistics.h"
#include "evaluator/report/study.h"
#include "evaluator/report/table.h"
#include "trajectory/paired_statistics.h"

namespace lcmslam::report {

// The first system against one of the others, in one kind of error.
struct Comparison {
  std::string system, other, error, unit;
  PairedComparison paired;
  double holm_p = 1.0;  // over all comparisons of the group
};
std::vector<Comparison> CompareSystems(const Group& group);

// Completion, error over episodes, coverage, time.
Table SystemsTable(const Group& group);
// The thesis' form: mean, median, SD of two systems with both ratios.
Table RatioTable(const Group& group);
Table ComparisonTable(const std::vector<Comparison>& comparisons);
// Every episode of every system, and why it failed.
Table EpisodesTable(const Group& group);
// All errors of one episode over its poses.
Table PoseErrorTable(const Group& group, const Episode& episode);
// Time of a scan and of its stages, and latency, in one episode; no rows where it is not known.
Table TimingTable(const Group& group, const Episode& episode);
// One sentence a system that it is compared with.
std::vector<std::string> Verdicts(const Group& group, const std::vector<Comparison>& comparisons);

}  // namespace lcmslam::report
