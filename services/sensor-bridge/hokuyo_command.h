#pragma once

#include <functional>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam {

// Adds the subcommand `hokuyo`, which hears a sensor until SIGTERM or SIGINT. When it is on the command line, parsing
// sets `command` to what runs it.
void AddHokuyoCommand(CLI::App& app, std::function<ExitCode()>& command);

}  // namespace lcmslam
