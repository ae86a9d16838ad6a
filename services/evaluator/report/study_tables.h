#pragma once

#include <string>
#include <vector>

#include "evaluator/report/study.h"
#include "evaluator/report/table.h"
#include "trajectory/paired_statistics.h"

namespace lcmslam::report {

// What is said of the mean error of each episode. Failed episodes rank worst in median, p95 and max and are left out of
// mean and SD only, where a number does not exist.
struct EpisodeSummary {
  int64_t episodes = 0, completed = 0;
  double mean = 0.0, sd = 0.0;  // over completed episodes; SD divides by n - 1
  double median = 0.0, p95 = 0.0, max = 0.0;
};
EpisodeSummary SummarizeEpisodes(std::vector<double> errors);

// Of each episode, in order; infinite when failed.
std::vector<double> TranslationErrors(const Group& group, const std::string& system);
std::vector<double> RotationErrors(const Group& group, const std::string& system);

// The first system against one of the others, in one kind of error.
struct Comparison {
  std::string system, other, error, unit;
  PairedComparison paired;
  double holm_p = 1.0;  // over all comparisons of the group
};
std::vector<Comparison> CompareSystems(const Study& study, const Group& group);

// One row for every group and system: the thesis' Tab. 4.1.
Table OverviewTable(const Study& study);
// Completion, error over episodes, coverage, time.
Table SystemsTable(const Study& study, const Group& group);
// The thesis' form: mean, median, SD of two systems with both ratios.
Table RatioTable(const Study& study, const Group& group);
Table ComparisonTable(const std::vector<Comparison>& comparisons);
// Every episode of every system, and why it failed.
Table EpisodesTable(const Study& study, const Group& group);
// All errors of one episode over its poses.
Table PoseErrorTable(const Study& study, const Episode& episode);
// Time of a scan and of its stages in one episode; no rows where it is not known.
Table TimingTable(const Study& study, const Episode& episode);
// One sentence a system that it is compared with.
std::vector<std::string> Verdicts(const Study& study, const Group& group, const std::vector<Comparison>& comparisons);

}  // namespace lcmslam::report
