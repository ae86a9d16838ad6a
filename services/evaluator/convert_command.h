#pragma once

#include <functional>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam {

// Adds the subcommand `convert IN OUT`: a trajectory from one format to another, poses and stamps unchanged. When it is
// on the command line, parsing sets `command` to what runs it.
void AddConvertCommand(CLI::App& app, std::function<ExitCode()>& command);

}  // namespace lcmslam
