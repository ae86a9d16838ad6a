#include "sensor-bridge/cloud_folder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "bus/errors.h"
#include "sensors/bad_input.h"
#include "sensors/input_file.h"
#include "sensors/kitti.h"

namespace lcmslam {
namespace {

namespace fs = std::filesystem;

constexpr double kKittiTurn_s = 0.1;

// Numbers in names count as such: 2.bin comes before 10.bin.
bool NameBefore(const fs::path& a, const fs::path& b) {
  return strverscmp(a.filename().c_str(), b.filename().c_str()) < 0;
}

std::vector<fs::path> FilesOf(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  if (files.empty()) throw BadInput(fmt::format("{}: no {} files", folder.string(), extension));
  std::ranges::sort(files, NameBefore);
  return files;
}

// What `parse` makes of a text file; its complaints with the file's name in front.
template <class Parse>
auto ParseFile(const fs::path& path, const Parse& parse) {
  const std::string text = ReadInput(path);
  try {
    return parse(text);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
  }
}

void RequireOnePerScan(const fs::path& path, size_t count, size_t scans) {
  if (count != scans) throw BadInput(fmt::format("{}: {} lines for {} scans", path.string(), count, scans));
}

// The first of these files that is there: the one that an option names, which has to be, or one that the layout has.
fs::path Choose(const fs::path& named, const std::vector<fs::path>& usual) {
  if (!named.empty() && !fs::is_regular_file(named))
    throw CommandError(ExitCode::kUsage, fmt::format("{}: no such file", named.string()));
  if (!named.empty()) return named;
  const auto found = std::ranges::find_if(usual, [](const fs::path& path) { return fs::is_regular_file(path); });
  return found == usual.end() ? fs::path() : *found;
}

void SetTimes(const fs::path& times, double rate_hz, CloudFolder& folder, const Note& note) {
  if (!times.empty()) {
    folder.utimes = ParseFile(times, ParseKittiTimes);
    RequireOnePerScan(times, folder.utimes.size(), folder.files.size());
    return;
  }
  note(fmt::format("no times: {} sweeps a second", rate_hz));
  for (size_t i = 0; i < folder.files.size(); ++i)
    folder.utimes.push_back(std::llround(1e6 * static_cast<double>(i) / rate_hz));
}

// The poses in the file are the camera's where there is a calibration, else the lidar's.
void SetPoses(const fs::path& poses, const fs::path& calibration, CloudFolder& folder, const Note& note) {
  if (poses.empty()) return;
  folder.T_world_body = ParseFile(poses, ParseKittiPoses);
  RequireOnePerScan(poses, folder.T_world_body.size(), folder.files.size());
  note(
      fmt::format("{}: poses of the {}", poses.string(), calibration.empty() ? "lidar" : "camera, moved to the lidar"));
  if (calibration.empty()) return;
  const Pose3 T_camera_lidar = ParseFile(calibration, ParseKittiCalibration);
  for (Pose3& pose : folder.T_world_body) pose = T_camera_lidar.inverse() * pose * T_camera_lidar;
}

}  // namespace

CloudFolder FindKittiScans(const CloudImportOptions& options, const Note& note) {
  const fs::path& top = options.file;
  const bool is_raw = fs::is_directory(top / "velodyne_points/data");
  const bool is_sequence = fs::is_directory(top / "velodyne");
  const fs::path ends = top / "velodyne_points/timestamps_end.txt";
  const fs::path times = Choose(options.times_file, {ends, top / "velodyne_points/timestamps.txt", top / "times.txt"});
  const fs::path poses = Choose(options.poses_file, {top / "poses.txt", top / "gt_lidar_kitti.txt"});

  CloudFolder folder;
  folder.files = FilesOf(is_raw ? top / "velodyne_points/data" : is_sequence ? top / "velodyne" : top, ".bin");
  folder.turn_s = options.turn_s.value_or(is_raw ? kKittiTurn_s : 0.0);  // the benchmark's are compensated for motion
  folder.stamp_before_end_us = times == ends ? 0 : std::llround(0.5e6 * folder.turn_s);
  SetTimes(times, options.rate_hz, folder, note);
  const fs::path calibration = top / "calib.txt";
  SetPoses(poses, fs::is_regular_file(calibration) ? calibration : fs::path(), folder, note);
  return folder;
}

CloudFolder FindClouds(const CloudImportOptions& options, const std::string& extension, const Note& note) {
  const fs::path times = Choose(options.times_file, {options.file / "times.txt"});
  const fs::path poses = Choose(options.poses_file, {options.file / "poses.txt"});
  CloudFolder folder;
  folder.files = FilesOf(options.file, extension);
  folder.turn_s = options.turn_s.value_or(0.0);
  folder.stamp_before_end_us = std::llround(0.5e6 * folder.turn_s);
  SetTimes(times, options.rate_hz, folder, note);
  SetPoses(poses, {}, folder, note);
  return folder;
}

}  // namespace lcmslam
