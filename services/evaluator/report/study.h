#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "evaluator/evaluation.pb.h"
#include "evaluator/report/bound.h"

namespace lcmslam::report {

// When an episode counts as failed; stated on the page.
struct FailureRule {
  double max_mean_m = 0.5;       // mean error
  double min_coverage = 0.9;     // of the association
  std::string Validate() const;  // "" or "field: reason"
};

// What one system left of one episode. Paths are "" where there is no such file.
struct Run {
  bool has_metrics = false;
  result::Evaluation metrics;
  result::MapQuality map_quality;  // empty where there is none
  std::filesystem::path metrics_file, trajectory, map, map_quality_file, config;
  std::string failure;  // "" or why it counts as failed
};

struct Episode {
  std::string name;
  std::filesystem::path folder;
  std::filesystem::path reference;  // trajectory
  std::filesystem::path bound_file;
  Bound bound;                      // NaN where there is no file
  std::map<std::string, Run> runs;  // by system, all systems of its group
};

// Episodes that are summed up together.
struct Group {
  std::string name;
  std::vector<std::string> systems;  // in the order in which they are shown
  std::vector<Episode> episodes;
};

struct Study {
  std::vector<std::string> systems;  // of all groups, in the order in which they are shown
  std::vector<Group> groups;
  FailureRule failure_rule;
};

// A folder is an episode when it holds SYSTEM_metrics.json files; else a group of all episodes below it. Folders that
// are episodes themselves form one group. A group is split where episodes have no system in common, nor others in
// between: nothing compares them. A system that is missing from an episode of its group failed there. Throws
// CommandError: kBadInput for folders without episodes and damaged metrics.
Study LoadStudy(const std::vector<std::filesystem::path>& folders, const FailureRule& rule);

// Mean translation error, m: absolute, or of the relations where there is no reference. Infinite when failed.
double TranslationError(const Run& run);
// The same for rotation, rad.
double RotationError(const Run& run);
// The error that the two above are the means of.
const result::PoseError& ErrorOf(const Run& run);

}  // namespace lcmslam::report
