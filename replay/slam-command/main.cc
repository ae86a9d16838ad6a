// slam-command COMMAND: tells a running SLAM service to save, load or forget its map, where it is, and whether to map.

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>
#include <lcmslam/slam_command_t.hpp>

#include "bus/clock.h"
#include "bus/live_bus.h"
#include "common/command_line.h"

namespace lcmslam {
namespace {

struct Arguments {
  slam_command_t command{};
  double yaw_rad = 0.0;
  std::string channel = "SLAM_COMMAND", lcm_url;
};

CLI::App* AddCommand(CLI::App& app, const std::string& name, const std::string& what, int8_t code,
                     slam_command_t& command) {
  CLI::App* added = app.add_subcommand(name, what)->fallthrough();
  added->callback([code, &command] { command.command = code; });
  return added;
}

void AddCommands(CLI::App& app, Arguments& arguments) {
  slam_command_t& command = arguments.command;
  AddCommand(app, "save", "save map files", slam_command_t::SAVE, command)
      ->add_option("STEM", command.path, "their path without endings, as the service sees it; default: in its --out");
  AddCommand(app, "load", "go on with a saved map", slam_command_t::LOAD, command)
      ->add_option("FILE", command.path, "as the service sees it")
      ->required();
  AddCommand(app, "reset", "begin anew", slam_command_t::RESET, command);
  CLI::App* pose = AddCommand(app, "pose", "say where the body is in the map", slam_command_t::SET_POSE, command);
  pose->add_option("X", command.pos[0], "m")->required();
  pose->add_option("Y", command.pos[1], "m")->required();
  pose->add_option("YAW", arguments.yaw_rad, "rad")->required();
  pose->add_option("Z", command.pos[2], "m");
  AddCommand(app, "localize-only", "leave the map as it is", slam_command_t::LOCALIZE_ONLY, command);
  AddCommand(app, "map", "take scans into the map again", slam_command_t::MAP_AND_LOCALIZE, command);
}

ExitCode Send(Arguments& arguments) {
  arguments.command.utime = WallClockUtime();
  arguments.command.quat[0] = std::cos(0.5 * arguments.yaw_rad);
  arguments.command.quat[3] = std::sin(0.5 * arguments.yaw_rad);
  LiveBus(arguments.lcm_url).Publish(arguments.channel, Encode(arguments.command));
  return ExitCode::kOk;
}

}  // namespace
}  // namespace lcmslam

int main(int argc, char** argv) {
  CLI::App app("Tells a running SLAM service what to do; it answers in the text of its status", "slam-command");
  lcmslam::Arguments arguments;
  app.require_subcommand(1);
  app.add_option("--service", arguments.command.service, "only this one; default: all on the bus");
  app.add_option("--channel", arguments.channel)->capture_default_str();
  app.add_option("--lcm-url", arguments.lcm_url, "default: LCM_DEFAULT_URL, else multicast on this host");
  lcmslam::AddCommands(app, arguments);
  return lcmslam::RunCommandLine(app, argc, argv, [&] { return lcmslam::Send(arguments); });
}
