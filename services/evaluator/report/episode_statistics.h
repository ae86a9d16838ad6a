#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evaluator/report/study.h"

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

// Share of the poses, or relations, that were judged.
double Coverage(const Run& run);

// The four below: medians over the episodes of the group that know it, NaN where none does.
// Of any figure of a run, NaN where the run does not know it.
double MedianOver(const Group& group, const std::string& system, const std::function<double(const Run&)>& value);
double MedianCoverage(const Group& group, const std::string& system);
// Of one figure of the time of a scan, ms.
double MedianStepMs(const Group& group, const std::string& system, double (result::Summary::*figure)() const);
// Of a figure of the translation error over the scans' Cramer-Rao bound; infinite when failed.
double MedianOverBound(const Group& group, const std::string& system, double (result::Summary::*error)() const,
                       double Bound::*bound);

}  // namespace lcmslam::report
