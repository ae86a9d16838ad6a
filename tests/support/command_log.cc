// command_log OUT.lcm SERVICE save|load|reset|pose [PATH | X Y YAW]: an LCM log of one SLAM_COMMAND to that service,
// for lcm-logplayer to send.
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include <fmt/format.h>
#include <lcmslam/slam_command_t.hpp>

#include "bus/errors.h"
#include "bus/log_writer.h"
#include "bus/wire.h"

int main(int argc, char** argv) {
  using lcmslam::slam_command_t;
  const std::map<std::string, int8_t> kinds{{"save", slam_command_t::SAVE},
                                            {"load", slam_command_t::LOAD},
                                            {"reset", slam_command_t::RESET},
                                            {"pose", slam_command_t::SET_POSE}};
  const bool is_pose = argc == 7 && std::string(argv[3]) == "pose";
  if (argc < 4 || !kinds.contains(argv[3]) || (argc > 5 && !is_pose)) {
    fmt::print(stderr, "usage: command_log OUT.lcm SERVICE save|load|reset|pose [PATH | X Y YAW]\n");
    return static_cast<int>(lcmslam::ExitCode::kUsage);
  }
  slam_command_t command{};
  command.command = kinds.at(argv[3]);
  command.quat[0] = 1.0;
  if (argc == 5) command.path = argv[4];
  command.service = argv[2];
  if (is_pose) {
    command.pos[0] = std::atof(argv[4]);
    command.pos[1] = std::atof(argv[5]);
    command.quat[0] = std::cos(0.5 * std::atof(argv[6]));
    command.quat[3] = std::sin(0.5 * std::atof(argv[6]));
  }
  lcmslam::LogWriter log(argv[1]);
  log.Write(0, "SLAM_COMMAND", lcmslam::Encode(command));
  return 0;
}
