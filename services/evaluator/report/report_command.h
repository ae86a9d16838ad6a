#pragma once

#include <functional>
#include <string>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam::report {

// Adds the subcommand `report DIR... --out FILE.html`. When it is on the command line, parsing sets `command` to what
// runs it. `typed` is the command line, for the record.
void AddReportCommand(CLI::App& app, const std::string& typed, std::function<ExitCode()>& command);

}  // namespace lcmslam::report
