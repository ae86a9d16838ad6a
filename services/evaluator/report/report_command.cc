#include "evaluator/report/report_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/config.h"
#include "evaluator/report/overview.h"
#include "evaluator/report/page.h"

namespace lcmslam::report {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> folders;
  PageOptions page{.title = "", .note = "", .command = "", .pictures = {}, .file = "report.html"};
  FailureRule failure;
};

std::string DefaultTitle(const Study& study) {
  if (study.systems.size() == 1) return study.systems.front();
  std::string title;
  for (const std::string& system : study.systems) title += (title.empty() ? "" : ", ") + system;
  return title + " compared";
}

}  // namespace

void AddReportCommand(CLI::App& app, const std::string& typed, std::function<ExitCode()>& command) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& report = *app.add_subcommand("report", "One HTML page of results folders, a run or many episodes each");
  report.add_option("DIR", arguments->folders, "results folder, or folder of such")->required();
  report.add_option("--out", arguments->page.file, "the page; pictures and tables go to a folder beside it");
  report.add_option("--title", arguments->page.title, "heading of the page");
  report.add_option("--note", arguments->page.note, "a sentence below the heading");
  report.add_option("--picture", arguments->page.pictures, "an SVG drawing that the page shows too (repeatable)")
      ->allow_extra_args(false);
  report.add_option("--failure", arguments->failure.max_mean_m, "m: an episode with a larger mean error failed");
  report.add_option("--failure-coverage", arguments->failure.min_coverage, "0 to 1: so does one with less coverage");
  report.callback([arguments, typed, &command] {
    command = [arguments, typed] {
      RequireValid(arguments->failure.Validate());
      arguments->page.command = typed;
      const Study study = LoadStudy(arguments->folders, arguments->failure);
      if (arguments->page.title.empty()) arguments->page.title = DefaultTitle(study);
      WritePage(study, arguments->page);
      fmt::print("{}\n{}", ToText(OverviewTable(study)), ToText(MedianTable(study)));
      return ExitCode::kOk;
    };
  });
}

}  // namespace lcmslam::report
