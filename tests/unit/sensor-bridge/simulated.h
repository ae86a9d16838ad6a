#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "bus/log_reader.h"
#include "common/command_line.h"
#include "sensor-bridge/simulate_command.h"
#include "support/temporary_file.h"

namespace lcmslam {

inline std::string FileBytes(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

// What `simulate` makes of an episode file.
struct Simulated {
  int exit_code = 0;
  std::string log;
  std::vector<Event> events;
  std::string standard_output;

  explicit Simulated(const std::string& episode, const std::vector<std::string>& options = {}) {
    const TemporaryFile episode_file(episode);
    const TemporaryFile out;
    std::vector<std::string> arguments{"sensor-bridge", "simulate",  "--episode",        episode_file.path(),
                                       "--quiet",       "--log-out", out.path().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    CLI::App app("test", "sensor-bridge");
    std::function<ExitCode()> command;
    AddSimulateCommand(app, command);
    testing::internal::CaptureStdout();
    exit_code = RunCommandLine(app, static_cast<int>(argv.size()), argv.data(), [&] { return command(); });
    standard_output = testing::internal::GetCapturedStdout();
    log = FileBytes(out.path());
    if (log.empty()) return;
    LogReader reader(out.path());
    for (Event event; reader.Next(event);) events.push_back(event);
  }
  std::vector<Event> On(const std::string& channel) const {
    std::vector<Event> chosen;
    for (const Event& event : events) {
      if (event.channel == channel) chosen.push_back(event);
    }
    return chosen;
  }
};

}  // namespace lcmslam
