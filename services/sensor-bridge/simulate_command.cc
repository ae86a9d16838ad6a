#include "sensor-bridge/simulate_command.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bus/signals.h"
#include "common/config.h"
#include "sensor-bridge/bridge_output.h"
#include "sensor-bridge/episode.pb.h"
#include "sensor-bridge/episode_config.h"
#include "sensor-bridge/simulate.h"

namespace lcmslam {
namespace {

struct SimulateOptions {
  std::string episode_file;
  std::string seed;  // "": the episode's
  std::vector<std::string> assignments;
  bool print_config = false;
  std::filesystem::path bound_file;
  OutputOptions output;
};

// Throws CommandError (kRuntime) unless all that was written to the file is in it.
void RequireWritten(std::ofstream& file, const std::filesystem::path& path) {
  if (!file.flush()) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", path.string()));
}

ExitCode Simulate(const SimulateOptions& options) {
  RequireValid(options.output.Validate());
  config::Episode config;
  LoadConfig(options.episode_file, config);
  for (const std::string& assignment : options.assignments) SetConfigField(assignment, config);
  if (!options.seed.empty()) SetConfigField("seed=" + options.seed, config);
  const Episode episode = MakeEpisode(config, std::filesystem::path(options.episode_file).parent_path());
  if (options.print_config) {
    fmt::print("{}", ConfigText(config));
    return ExitCode::kOk;
  }

  CatchStopSignals();
  BridgeOutput output(options.output);
  SensorPublisher publisher(output, options.output.quiet);
  std::ofstream bound_file;
  if (!options.bound_file.empty()) {
    bound_file.open(options.bound_file, std::ios::binary);
    RequireWritten(bound_file, options.bound_file);
  }
  BoundSummary bound(options.bound_file.empty() ? nullptr : &bound_file);
  std::visit(
      [&](const auto& any_episode) {
        publisher.ExpectScans(any_episode.num_frames());
        PublishEpisode(any_episode, publisher, bound);
      },
      episode);
  publisher.Finish();
  output.Finish();
  if (!options.bound_file.empty()) RequireWritten(bound_file, options.bound_file);
  if (!options.output.quiet) fmt::print(stderr, "sensor-bridge: {}\n", publisher.Summary());
  fmt::print("{}\n", bound.Line());
  return ExitCode::kOk;
}

}  // namespace

void AddSimulateCommand(CLI::App& app, std::function<ExitCode()>& command) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* simulate = app.add_subcommand("simulate", "Take a simulated lidar through a simulated world");
  simulate->add_option("--episode", options->episode_file, "Protocol Buffers text, see episode.proto")->required();
  simulate->add_option("--seed", options->seed, "instead of the episode's")->type_name("INT");
  simulate->add_option("--set", options->assignments, "path=value: set one field of the episode (repeatable)")
      ->allow_extra_args(false);
  simulate->add_flag("--print-config", options->print_config, "print the episode with its defaults and end");
  simulate->add_option("--bound", options->bound_file, "write the Cramer-Rao bound of each scan to this CSV file");
  AddPacedOutputOptions(*simulate, options->output);
  simulate->callback([options, &command] { command = [options] { return Simulate(*options); }; });
}

}  // namespace lcmslam
