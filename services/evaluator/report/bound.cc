#include "evaluator/report/bound.h"

#include <algorithm>
#include <vector>

#include "bus/errors.h"
#include "trajectory/summary.h"
#include "trajectory/text_lines.h"

namespace lcmslam::report {

Bound ReadBound(const std::filesystem::path& path) {
  TextLines lines(path);
  const auto fail = [](const std::string& line) { throw CommandError(ExitCode::kBadInput, line); };
  if (!lines.Next()) fail(lines.error().empty() ? path.string() + ": empty" : lines.error());
  const auto header = std::ranges::find(lines.fields(), "position_m");
  if (header == lines.fields().end()) fail(lines.Complain("no column position_m"));
  const auto column = static_cast<size_t>(header - lines.fields().begin());

  std::vector<double> bounds_m;
  while (lines.Next()) {
    if (lines.fields().size() <= column) fail(lines.Complain("too few columns"));
    const std::string_view field = lines.fields()[column];
    if (field == "inf") continue;
    const auto value = ParseFinite(field);
    if (!value || *value < 0.0) fail(lines.Complain(Quote(field) + " is no bound"));
    bounds_m.push_back(*value);
  }
  const Summary summary = Summarize(bounds_m);
  return {summary.mean, summary.rmse};
}

}  // namespace lcmslam::report
