#include "common/run_service.h"

#include <fstream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/command_line.h"
#include "common/config.h"

namespace lcmslam {
namespace {

void WriteEffectiveConfig(const RunOptions& options, const ServiceParts& parts) {
  if (options.out.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  const std::filesystem::path path = options.out / (parts.name + ".pbtxt");
  std::ofstream file(path);
  file << ConfigText(*parts.config);
  if (!file.flush()) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", path.string()));
}

ExitCode Run(const RunOptions& options, const ServiceParts& parts) {
  WriteEffectiveConfig(options, parts);
  ServiceContext context(parts.name, options);
  const ExitCode code = options.log_in.empty() ? RunLive(context, parts.make) : RunLogToLog(context, parts.make);
  if (!options.quiet) fmt::print(stderr, "{}\n", context.health().Summary());
  return code;
}

}  // namespace

int RunCommand(const std::string& name, const std::function<ExitCode()>& body) {
  try {
    return static_cast<int>(body());
  } catch (const CommandError& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(ExitCode::kRuntime);
  }
}

int RunServiceParts(int argc, char** argv, const ServiceParts& parts) {
  CLI::App app(parts.description, parts.name);
  RunOptions options;
  std::string config_path;
  std::vector<std::string> assignments;
  bool print_config = false;
  app.add_option("--config", config_path, "configuration, Protocol Buffers text format");
  app.add_option("--set", assignments, "path=value: set one field of the configuration (repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--print-config", print_config, "print the effective configuration and end");
  auto* url = app.add_option("--lcm-url", options.lcm_url, "bus; default $LCM_DEFAULT_URL, else udpm with ttl=0");
  auto* log_in = app.add_option("--log-in", options.log_in, "read this LCM log instead of the bus")->excludes(url);
  app.add_option("--log-out", options.log_out, "write its events and what they cause to this log")->needs(log_in);
  app.add_option("--out", options.out, "folder for maps, trajectories and the effective configuration");
  app.add_flag("--timings", options.timings, "wall-clock figures in --log-out (its bytes then differ from run to run)");
  app.add_flag("--quiet", options.quiet, "no progress bar, no summary");
  return RunCommandLine(app, argc, argv, [&] {
    if (!config_path.empty()) LoadConfig(config_path, *parts.config);
    for (const std::string& assignment : assignments) SetConfigField(assignment, *parts.config);
    parts.complete();
    if (print_config) {
      fmt::print("{}", ConfigText(*parts.config));
      return ExitCode::kOk;
    }
    return Run(options, parts);
  });
}

}  // namespace lcmslam
