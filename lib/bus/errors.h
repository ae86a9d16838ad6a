#pragma once

#include <stdexcept>
#include <string>

namespace lcmslam {

// What every command of the project returns to the shell.
enum class ExitCode { kOk = 0, kRuntime = 1, kUsage = 2, kBadInput = 3, kNothingMatched = 4, kThresholdMissed = 5 };

// Ends a command with one line on stderr and the code. Thrown by services and commands, caught by their runner.
class CommandError : public std::runtime_error {
 public:
  CommandError(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace lcmslam
