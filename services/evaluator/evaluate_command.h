#pragma once

#include <filesystem>
#include <string>

#include "bus/errors.h"
#include "common/run_service.h"
#include "trajectory/read.h"

namespace CLI {
class App;
}

namespace lcmslam {

namespace config {
class Evaluator;
}

// The command line of evaluator, besides what every service has.
struct EvaluateArguments {
  std::string command;  // as it was typed, for the record
  ServiceArguments service;
  std::string estimate, reference;  // file, or channel of the log or bus
  std::filesystem::path relations;
  std::filesystem::path json;
  std::filesystem::path evo_zip;
  ReadOptions read;
};
// Flags that are configuration too (--align, --max-mean, ...) go into `flags`, which RunEvaluate lets win over --config
// and --set. Both have to outlive the parsing.
void AddEvaluateOptions(CLI::App& app, EvaluateArguments& arguments, config::Evaluator& flags);

// Evaluates files or a log, or runs on the bus; prints the table, writes JSON. kThresholdMissed when a demand is
// missed.
ExitCode RunEvaluate(const EvaluateArguments& arguments, const config::Evaluator& flags);

}  // namespace lcmslam
