#include "common/run_service.h"

#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/command_line.h"
#include "common/config.h"

namespace lcmslam {
int RunCommand(const std::string& name, const std::function<ExitCode()>& body) {
  try {
    const ExitCode code = body();
    if (std::fflush(stdout) != 0) throw CommandError(ExitCode::kRuntime, "standard output cannot be written");
    return static_cast<int>(code);
  } catch (const CommandError& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(ExitCode::kRuntime);
  }
}

void AddServiceOptions(CLI::App& app, ServiceArguments& arguments) {
  RunOptions& run = arguments.run;
  app.add_option("--config", arguments.config_path, "configuration, Protocol Buffers text format");
  app.add_option("--set", arguments.assignments, "path=value: set one field of the configuration (repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--print-config", arguments.print_config, "print the effective configuration and end");
  auto* url = app.add_option("--lcm-url", run.lcm_url, "bus; default $LCM_DEFAULT_URL, else udpm with ttl=0");
  auto* log_in = app.add_option("--log-in", run.log_in, "read this LCM log instead of the bus")->excludes(url);
  app.add_option("--log-out", run.log_out, "write its events and what they cause to this log")->needs(log_in);
  app.add_option("--out", run.out, "folder for maps, trajectories and the effective configuration");
  app.add_flag("--timings", run.timings, "wall-clock figures in --log-out (its bytes then differ from run to run)");
  app.add_flag("--quiet", run.quiet, "no progress bar, no summary");
}

void LoadConfig(const ServiceArguments& arguments, google::protobuf::Message& config) {
  if (!arguments.config_path.empty()) LoadConfig(arguments.config_path, config);
  for (const std::string& assignment : arguments.assignments) SetConfigField(assignment, config);
}

void WriteEffectiveConfig(const std::filesystem::path& out, const std::string& name,
                          const google::protobuf::Message& config) {
  if (out.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(out, error);
  const std::filesystem::path path = out / (name + ".pbtxt");
  std::ofstream file(path);
  file << ConfigText(config);
  if (!file.flush()) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", path.string()));
}

ExitCode RunOnBus(const RunOptions& options, const ServiceParts& parts) {
  WriteEffectiveConfig(options.out, parts.name, *parts.config);
  ServiceContext context(parts.name, options);
  const ExitCode code = options.log_in.empty() ? RunLive(context, parts.make) : RunLogToLog(context, parts.make);
  if (!options.quiet) fmt::print(stderr, "{}\n", context.health().Summary());
  return code;
}

int RunServiceParts(int argc, char** argv, const ServiceParts& parts) {
  CLI::App app(parts.description, parts.name);
  ServiceArguments arguments;
  AddServiceOptions(app, arguments);
  return RunCommandLine(app, argc, argv, [&] {
    LoadConfig(arguments, *parts.config);
    parts.complete();
    if (arguments.print_config) {
      fmt::print("{}", ConfigText(*parts.config));
      return ExitCode::kOk;
    }
    return RunOnBus(arguments.run, parts);
  });
}

}  // namespace lcmslam
