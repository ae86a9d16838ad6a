#include <CLI/CLI.hpp>

#include "common/command_line.h"
#include "evaluator/convert_command.h"
#include "evaluator/evaluate_command.h"
#include "evaluator/evaluator.pb.h"
#include "evaluator/map/map_command.h"
#include "evaluator/report/report_command.h"

int main(int argc, char** argv) {
  using namespace lcmslam;
  CLI::App app("Judges estimated trajectories by a reference: files, a log, or live on the bus", "evaluator");
  EvaluateArguments arguments;
  config::Evaluator flags;
  arguments.command = "evaluator";
  for (int i = 1; i < argc; ++i) arguments.command += std::string(" ") + argv[i];
  std::function<ExitCode()> command = [&] { return RunEvaluate(arguments, flags); };
  AddServiceOptions(app, arguments.service);
  AddEvaluateOptions(app, arguments, flags);
  AddConvertCommand(app, command);
  AddMapCommand(app, arguments.command, command);
  report::AddReportCommand(app, arguments.command, command);
  return RunCommandLine(app, argc, argv, [&] { return command(); });
}
