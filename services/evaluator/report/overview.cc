#include "evaluator/report/overview.h"

#include <algorithm>

#include <fmt/format.h>

#include "evaluator/report/episode_statistics.h"
#include "evaluator/report/numbers.h"

namespace lcmslam::report {

Table OverviewTable(const Study& study) {
  Table table;
  table.name = "overview";
  table.caption = fmt::format(
      "Mean position and rotation error of each episode, summed up over episodes; failed: mean error above {:g} m or "
      "coverage below {:g} %. Mean and SD (n - 1) over completed episodes; in the median failed ones rank worst. "
      "Ratios: "
      "of position errors, over the first system of the group. Mean / bound: mean error over the mean of the scans' "
      "Cramer-Rao bounds, median over episodes. Times: of a scan, wall clock, median over episodes.",
      study.failure_rule.max_mean_m, 100.0 * study.failure_rule.min_coverage);
  table.header = {"episodes",    "system",         "completed",  "mean [mm]",    "median [mm]", "SD [mm]",
                  "rot. [mrad]", "rot. SD [mrad]", "mean ratio", "median ratio", "SD ratio",    "mean / bound",
                  "mean [ms]",   "median [ms]",    "p95 [ms]",   "p99 [ms]"};
  table.text_columns = 2;
  for (const Group& group : study.groups) {
    const EpisodeSummary first = SummarizeEpisodes(TranslationErrors(group, group.systems.front()));
    for (const std::string& system : group.systems) {
      const EpisodeSummary s = SummarizeEpisodes(TranslationErrors(group, system));
      const EpisodeSummary r = SummarizeEpisodes(RotationErrors(group, system));
      table.rows.push_back({group.name, system, fmt::format("{}/{}", s.completed, s.episodes), Millimetres(s.mean),
                            Millimetres(s.median), Millimetres(s.sd), Milliradians(r.mean), Milliradians(r.sd),
                            Number(s.mean / first.mean), Number(s.median / first.median), Number(s.sd / first.sd),
                            Number(MedianOverBound(group, system, &result::Summary::mean, &Bound::mean_m)),
                            Number(MedianStepMs(group, system, &result::Summary::mean)),
                            Number(MedianStepMs(group, system, &result::Summary::median)),
                            Number(MedianStepMs(group, system, &result::Summary::p95)),
                            Number(MedianStepMs(group, system, &result::Summary::p99))});
    }
  }
  return table;
}

Table MedianTable(const Study& study) {
  Table table{"medians",
              "Median over episodes of the mean position error [mm], and how many episodes failed.",
              {"system"},
              {},
              1};
  for (const Group& group : study.groups) table.header.push_back(group.name);
  for (const std::string& system : study.systems) {
    std::vector<std::string> row = {system};
    for (const Group& group : study.groups) {
      if (std::ranges::find(group.systems, system) == group.systems.end()) {
        row.emplace_back("-");
        continue;
      }
      const EpisodeSummary s = SummarizeEpisodes(TranslationErrors(group, system));
      const int64_t failed = s.episodes - s.completed;
      row.push_back(Millimetres(s.median) + (failed == 0 ? "" : fmt::format(" ({} of {})", failed, s.episodes)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace lcmslam::report
