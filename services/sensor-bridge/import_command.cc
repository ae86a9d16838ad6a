#include "sensor-bridge/import_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bus/signals.h"
#include "common/config.h"
#include "sensor-bridge/log_import.h"
#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

using Import = std::function<void(SensorPublisher&, const Note&)>;

// Runs `import` onto the bus or into a log; what came before an error is published all the same.
ExitCode RunImport(const std::filesystem::path& file, const OutputOptions& options, const Import& import,
                   bool is_folder = false) {
  RequireValid(options.Validate());
  std::error_code not_there;
  if (std::filesystem::equivalent(file, options.log_out, not_there))
    throw CommandError(ExitCode::kUsage, "--log-out: is the file to be imported");
  if (!std::filesystem::exists(file, not_there))  // before --log-out is made
    throw CommandError(ExitCode::kBadInput, fmt::format("{}: no such file", file.string()));
  if (std::filesystem::is_directory(file, not_there) != is_folder)
    throw CommandError(ExitCode::kBadInput, fmt::format("{}: {} folder", file.string(), is_folder ? "is no" : "is a"));
  CatchStopSignals();
  BridgeOutput output(options);
  SensorPublisher publisher(output, options.quiet);
  const auto say = [&](const std::string& line) {
    if (!options.quiet) fmt::print(stderr, "sensor-bridge: {}\n", line);
  };
  std::string bad_input;
  try {
    import(publisher, say);
  } catch (const BadInput& error) {
    bad_input = error.what();
  } catch (const CommandError& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    bad_input = error.what();
  }
  publisher.Finish();
  output.Finish();
  say(publisher.Summary());
  if (!bad_input.empty()) throw CommandError(ExitCode::kBadInput, bad_input);
  return ExitCode::kOk;
}

// Adds `import FORMAT FILE` with the options that all formats share.
template <class Options>
CLI::App* AddFormat(CLI::App& import, const std::string& name, const std::string& description, Options& options,
                    OutputOptions& output) {
  CLI::App* format = import.add_subcommand(name, description);
  format->add_option(std::is_same_v<Options, CloudImportOptions> ? "FOLDER" : "FILE", options.file)->required();
  AddPacedOutputOptions(*format, output);
  return format;
}

void AddCarmen(CLI::App& import, OutputOptions& output, std::function<ExitCode()>& command) {
  auto options = std::make_shared<CarmenImportOptions>();
  CLI::App* format = AddFormat(import, "carmen", "CARMEN log, plain, .gz or .bz2", *options, output);
  format->add_option("--scan-line", options->scan_line, "FLASER, RLASER, ...: the one for LIDAR_2D");
  format->add_option("--max-range", options->log.max_range_m, "m; from here on no return, where the log does not say")
      ->capture_default_str();
  format->add_option("--front-laser-offset", options->log.front_laser_offset_m, "m; instead of the log's PARAM");
  format->add_option("--scan-delay", options->scan_delay_s, "s; how long before their stamps scans were measured")
      ->capture_default_str();
  format->callback([=, &output, &command] {
    command = [=, &output] {
      RequireValid(options->Validate());
      return RunImport(options->file, output,
                       [=](auto& publisher, auto& note) { ImportCarmen(*options, publisher, note); });
    };
  });
}

void AddRosbag(CLI::App& import, OutputOptions& output, std::function<ExitCode()>& command) {
  auto options = std::make_shared<RosbagImportOptions>();
  CLI::App* format = AddFormat(import, "rosbag", "ROS 1 bag, format 2.0", *options, output);
  format->add_option("--scan-topic", options->scan_topic, "the LaserScan topic for LIDAR_2D");
  format->add_option("--cloud-topic", options->cloud_topic, "the PointCloud2 topic for LIDAR_3D");
  format->add_option("--imu-topic", options->imu_topic, "the Imu topic for IMU");
  format->add_option("--odometry-topic", options->odometry_topic, "the pose topic for ODOMETRY");
  format->add_option("--ground-truth-topic", options->ground_truth_topic, "the pose topic for GROUND_TRUTH");
  format->add_option("--base-frame", options->base_frame, "tf frame of the body");
  format->callback([=, &output, &command] {
    command = [=, &output] {
      return RunImport(options->file, output,
                       [=](auto& publisher, auto& note) { ImportRosbag(*options, publisher, note); });
    };
  });
}

void AddMbot(CLI::App& import, OutputOptions& output, std::function<ExitCode()>& command) {
  auto options = std::make_shared<MbotImportOptions>();
  CLI::App* format = AddFormat(import, "mbot", "LCM log with the message types of MBot or bot_core", *options, output);
  format->add_option("--scan-channel", options->scan_channel, "the scan channel for LIDAR_2D");
  format->add_option("--odometry-channel", options->odometry_channel, "the pose channel for ODOMETRY")
      ->capture_default_str();
  format->add_option("--ground-truth-channel", options->ground_truth_channel, "the pose channel for GROUND_TRUTH")
      ->capture_default_str();
  auto clockwise = std::make_shared<bool>(), counter_clockwise = std::make_shared<bool>();
  auto* flag = format->add_flag("--clockwise", *clockwise, "the scans' angles count clockwise; default: detected");
  format->add_flag("--counter-clockwise", *counter_clockwise, "they count counter-clockwise")->excludes(flag);
  format->callback([=, &output, &command] {
    if (*clockwise) options->sense = AngleSense::kClockwise;
    if (*counter_clockwise) options->sense = AngleSense::kCounterClockwise;
    command = [=, &output] {
      return RunImport(options->file, output,
                       [=](auto& publisher, auto& note) { ImportMbot(*options, publisher, note); });
    };
  });
}

void AddVelodyne(CLI::App& import, OutputOptions& output, std::function<ExitCode()>& command) {
  auto options = std::make_shared<VelodyneImportOptions>();
  CLI::App* format = AddFormat(
      import, "velodyne", "VLP-16 or HDL-32E: pcap, bare payloads, or LCM log with LIDAR_3D_PACKET", *options, output);
  format->add_option("--port", options->port, "only datagrams to this UDP port; 0: to any")->capture_default_str();
  format->add_flag("--packets", options->keep_packets, "the payloads go to LIDAR_3D_PACKET as well");
  format->callback([=, &output, &command] {
    command = [=, &output] {
      return RunImport(options->file, output,
                       [=](auto& publisher, auto& note) { ImportVelodyne(*options, publisher, note); });
    };
  });
}

using ImportClouds = void (*)(const CloudImportOptions&, SensorPublisher&, const Note&);

// A format that is a folder with a file a sweep.
void AddClouds(CLI::App& import, const std::string& name, const std::string& description, ImportClouds import_clouds,
               OutputOptions& output, std::function<ExitCode()>& command) {
  auto options = std::make_shared<CloudImportOptions>();
  CLI::App* format = AddFormat(import, name, description, *options, output);
  format->add_option("--rate", options->rate_hz, "sweeps a second, where there are no times")->capture_default_str();
  format->add_option("--times", options->times_file, "seconds, a line a sweep; default times.txt");
  format->add_option("--poses", options->poses_file, "3x4 matrices, a line a sweep; default poses.txt");
  format->add_option("--turn", options->turn_s, "s; points get times by azimuth; 0: none");
  format->add_option("--lidar", options->lidar, "vlp16, hdl32e, hdl64e, os1-64: points get rings by elevation");
  format->callback([=, &output, &command] {
    command = [=, &output] {
      RequireValid(options->Validate());
      return RunImport(
          options->file, output, [=](auto& publisher, auto& note) { import_clouds(*options, publisher, note); }, true);
    };
  });
}

}  // namespace

void AddImportCommand(CLI::App& app, std::function<ExitCode()>& command) {
  CLI::App* import = app.add_subcommand("import", "Convert a log of another system");
  import->require_subcommand(1);
  auto output = std::make_shared<OutputOptions>();
  AddCarmen(*import, *output, command);
  AddRosbag(*import, *output, command);
  AddMbot(*import, *output, command);
  AddVelodyne(*import, *output, command);
  AddClouds(*import, "kitti", "folder of the KITTI benchmark, of a raw drive, or of .bin scans", ImportKitti, *output,
            command);
  AddClouds(*import, "pcd", "folder of PCD files", ImportPcd, *output, command);
  AddClouds(*import, "ply", "folder of PLY files", ImportPly, *output, command);
  import->callback([output]{});  // keeps the options as long as the command line
}

}  // namespace lcmslam
