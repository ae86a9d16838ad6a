#include "evaluator/convert_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "evaluator/pose_sources.h"
#include "trajectory/write.h"

namespace lcmslam {
namespace {

struct Arguments {
  std::filesystem::path in, out;
  std::string channel;  // of a log; "" for a trajectory file
  std::string to;       // tum, euroc, kitti; "" by the extension of `out`
  ReadOptions read;
};

std::string FormatByExtension(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".csv" ? "euroc" : extension == ".kitti" ? "kitti" : "tum";
}

// Where the stamps of KITTI poses go, which have none themselves: poses.kitti -> poses_times.txt.
std::filesystem::path TimesPath(const std::filesystem::path& poses) {
  return poses.parent_path() / (poses.stem().string() + "_times.txt");
}

std::string Write(const Trajectory& trajectory, const std::string& format, const std::filesystem::path& path) {
  if (format == "euroc") return WriteEuroc(path, trajectory);
  if (format == "kitti") return WriteKitti(path, trajectory, TimesPath(path));
  return WriteTum(path, trajectory);
}

ExitCode Convert(const Arguments& arguments) {
  const PoseSource source = arguments.channel.empty()
                                ? ReadPoseFile(arguments.in, arguments.read)
                                : ReadPoseChannels(arguments.in, arguments.channel, "", /*quiet=*/false).estimate;
  const std::string format = arguments.to.empty() ? FormatByExtension(arguments.out) : arguments.to;
  const std::string error = Write(source.trajectory, format, arguments.out);
  if (!error.empty()) throw CommandError(ExitCode::kRuntime, error);
  fmt::print("{}: {} poses as {}{}\n", arguments.out.string(), source.trajectory.size(), format,
             format == "kitti" ? ", stamps in " + TimesPath(arguments.out).string() : "");
  return ExitCode::kOk;
}

}  // namespace

void AddConvertCommand(CLI::App& app, std::function<ExitCode()>& command) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& convert = *app.add_subcommand("convert", "A trajectory from one format to another");
  convert.add_option("IN", arguments->in, "TUM, planar, EuRoC or KITTI file, or a log with --channel")->required();
  convert.add_option("OUT", arguments->out, ".csv: EuRoC; .kitti: KITTI, stamps in NAME_times.txt; else TUM")
      ->required();
  convert.add_option("--to", arguments->to, "the format of OUT, whatever it is called")
      ->check(CLI::IsMember({"tum", "euroc", "kitti"}));
  convert.add_option("--channel", arguments->channel, "IN is a log, and these are its poses");
  convert.add_option("--kitti-times", arguments->read.kitti_times, "stamps of KITTI poses in IN, one a line, s");
  convert.callback([arguments, &command] { command = [arguments] { return Convert(*arguments); }; });
}

}  // namespace lcmslam
