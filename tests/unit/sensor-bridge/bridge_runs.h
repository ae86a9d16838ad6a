#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <lcmslam/point_cloud_chunk_t.hpp>

#include "bus/log_reader.h"
#include "bus/sweep_chunks.h"
#include "common/command_line.h"
#include "sensor-bridge/hokuyo_command.h"
#include "sensor-bridge/import_command.h"
#include "sensor-bridge/simulate_command.h"
#include "support/temporary_file.h"

namespace lcmslam {

// The exit code of `sensor-bridge ARGUMENTS`.
inline int Bridge(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "sensor-bridge");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  CLI::App app("test", "sensor-bridge");
  std::function<ExitCode()> command;
  AddImportCommand(app, command);
  AddSimulateCommand(app, command);
  AddHokuyoCommand(app, command);
  return RunCommandLine(app, static_cast<int>(argv.size()), argv.data(), [&] { return command(); });
}

inline std::string FileBytes(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

// A run of the bridge that wrote a log.
struct BridgeRun {
  int exit_code = 0;
  std::string log;  // its bytes
  std::vector<Event> events;

  std::vector<std::string> Channels() const {
    std::vector<std::string> channels;
    for (const Event& event : events) channels.push_back(event.channel);
    return channels;
  }
  std::vector<Event> On(const std::string& channel) const {
    std::vector<Event> chosen;
    for (const Event& event : events) {
      if (event.channel == channel) chosen.push_back(event);
    }
    return chosen;
  }
  std::vector<Sweep> SweepsOn(const std::string& channel) const {
    SweepAssembler assembler;
    std::vector<Sweep> sweeps;
    for (const Event& event : On(channel)) {
      for (Sweep& sweep : assembler.Add(*DecodeChunk(event.data))) sweeps.push_back(std::move(sweep));
    }
    EXPECT_TRUE(assembler.Finish().empty());
    EXPECT_EQ(assembler.missing(), 0);
    return sweeps;
  }

  // `arguments` without --log-out.
  void Run(std::vector<std::string> arguments) {
    const TemporaryFile out;
    arguments.insert(arguments.end(), {"--log-out", out.path().string(), "--quiet"});
    exit_code = Bridge(arguments);
    log = FileBytes(out.path());
    if (log.empty()) return;
    LogReader reader(out.path());
    for (Event event; reader.Next(event);) events.push_back(event);
  }
};

// What `import FORMAT` makes of a file or folder.
struct Imported : BridgeRun {
  Imported(const std::string& format, const std::filesystem::path& file, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"import", format, file.string()});
    Run(options);
  }
};

// What `simulate` makes of an episode file's text.
struct Simulated : BridgeRun {
  std::string standard_output;

  explicit Simulated(const std::string& episode, std::vector<std::string> options = {}) {
    const TemporaryFile file(episode);
    options.insert(options.begin(), {"simulate", "--episode", file.path().string()});
    testing::internal::CaptureStdout();
    Run(options);
    standard_output = testing::internal::GetCapturedStdout();
  }
};

}  // namespace lcmslam
