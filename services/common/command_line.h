#pragma once

#include <functional>

#include "bus/errors.h"

namespace CLI {
class App;
}

namespace lcmslam {

// Adds --version, parses, and runs `body` by the rules of RunCommand. Bad usage: one line on stderr, kUsage.
int RunCommandLine(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& body);

}  // namespace lcmslam
