#include "common/command_line.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/run_service.h"

namespace lcmslam {

int RunCommandLine(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& body) {
  app.set_version_flag("--version", LCMSLAM_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return static_cast<int>(ExitCode::kUsage);
  }
  return RunCommand(app.get_name(), body);
}

}  // namespace lcmslam
