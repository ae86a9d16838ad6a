#pragma once

#include <functional>
#include <string>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam {

// Adds the subcommand `map`: how good a map is, by the true surface of a simulation or by the thickness of its walls.
// When it is on the command line, parsing sets `command` to what runs it. `typed` is the command line, for the record.
void AddMapCommand(CLI::App& app, const std::string& typed, std::function<ExitCode()>& command);

}  // namespace lcmslam
