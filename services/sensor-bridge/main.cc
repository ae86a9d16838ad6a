#include <CLI/CLI.hpp>

#include "common/command_line.h"
#include "sensor-bridge/hokuyo_command.h"
#include "sensor-bridge/import_command.h"
#include "sensor-bridge/simulate_command.h"
#include "sensor-bridge/velodyne_command.h"

int main(int argc, char** argv) {
  CLI::App app("Brings sensors, logs and simulations onto the bus or into an LCM log", "sensor-bridge");
  app.require_subcommand(1);
  std::function<lcmslam::ExitCode()> command;
  lcmslam::AddImportCommand(app, command);
  lcmslam::AddSimulateCommand(app, command);
  lcmslam::AddVelodyneCommand(app, command);
  lcmslam::AddHokuyoCommand(app, command);
  return lcmslam::RunCommandLine(app, argc, argv, [&] { return command(); });
}
