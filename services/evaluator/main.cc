#include <CLI/CLI.hpp>

#include "common/command_line.h"
#include "evaluator/evaluate_command.h"
#include "evaluator/evaluator.pb.h"

int main(int argc, char** argv) {
  CLI::App app("Judges estimated trajectories by a reference: files, a log, or live on the bus", "evaluator");
  lcmslam::EvaluateArguments arguments;
  lcmslam::config::Evaluator flags;
  for (int i = 0; i < argc; ++i) arguments.command += (i == 0 ? "" : " ") + std::string(i == 0 ? "evaluator" : argv[i]);
  lcmslam::AddServiceOptions(app, arguments.service);
  lcmslam::AddEvaluateOptions(app, arguments, flags);
  return lcmslam::RunCommandLine(app, argc, argv, [&] { return lcmslam::RunEvaluate(arguments, flags); });
}
