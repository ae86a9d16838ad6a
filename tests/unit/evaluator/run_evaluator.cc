#include "unit/evaluator/run_evaluator.h"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/command_line.h"
#include "evaluator/convert_command.h"
#include "evaluator/evaluate_command.h"
#include "evaluator/evaluator.pb.h"
#include "evaluator/map/map_command.h"
#include "evaluator/report/report_command.h"

namespace lcmslam::testing {

Outcome RunEvaluator(std::vector<std::string> arguments) {
  CLI::App app("test", "evaluator");
  EvaluateArguments evaluate;
  config::Evaluator flags;
  std::function<ExitCode()> command = [&] { return RunEvaluate(evaluate, flags); };
  AddServiceOptions(app, evaluate.service);
  AddEvaluateOptions(app, evaluate, flags);
  AddConvertCommand(app, command);
  AddMapCommand(app, "evaluator map", command);
  report::AddReportCommand(app, "evaluator report", command);

  arguments.insert(arguments.begin(), "evaluator");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.code = RunCommandLine(app, static_cast<int>(argv.size()), argv.data(), [&] { return command(); });
  std::fflush(stdout);
  outcome.out = ::testing::internal::GetCapturedStdout();
  outcome.error = ::testing::internal::GetCapturedStderr();
  return outcome;
}

void ExpectRefused(const std::vector<std::string>& arguments, int code, const std::string& error) {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  const Outcome run = RunEvaluator(arguments);
  EXPECT_EQ(run.code, code);
  EXPECT_THAT(run.error, ::testing::HasSubstr(error));
  EXPECT_THAT(run.error, ::testing::MatchesRegex("evaluator: [^\n]*\n"));
}

}  // namespace lcmslam::testing
