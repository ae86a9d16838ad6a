#pragma once

#include <functional>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam {

// Adds the subcommand `simulate --episode FILE`. When it is on the command line, parsing sets `command` to what runs
// it.
void AddSimulateCommand(CLI::App& app, std::function<ExitCode()>& command);

}  // namespace lcmslam
