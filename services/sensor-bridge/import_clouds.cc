#include <cmath>
#include <functional>
#include <span>

#include <fmt/format.h>

#include "bus/signals.h"
#include "lidar/multi_line_model.h"
#include "sensor-bridge/cloud_folder.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"
#include "sensors/arrange_points.h"
#include "sensors/bad_input.h"
#include "sensors/input_file.h"
#include "sensors/kitti.h"
#include "sensors/pcd.h"
#include "sensors/ply.h"

namespace lcmslam {
namespace {

using DecodePoints = std::function<std::vector<SweepPoint>(std::span<const uint8_t> file)>;

std::vector<SweepPoint> ReadPoints(const std::filesystem::path& path, const DecodePoints& decode) {
  const std::string bytes = ReadInput(path);
  try {
    return decode({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
  }
}

void ImportFolder(const CloudFolder& folder, const DecodePoints& decode, const std::string& lidar,
                  SensorPublisher& publisher) {
  const std::optional<MultiLineModel> model = NamedMultiLineModel(lidar);
  publisher.ExpectScans(static_cast<int64_t>(folder.files.size()));
  for (size_t i = 0; i < folder.files.size() && !StopRequested(); ++i) {
    Sweep sweep{.utime = folder.utimes[i] + folder.stamp_before_end_us, .points = ReadPoints(folder.files[i], decode)};
    DropNoReturns(sweep.points);
    if (model) SetRingsByElevation(*model, sweep.points);
    if (folder.turn_s > 0.0) SetTimesByAzimuth(folder.turn_s, sweep.points);
    SortByTime(sweep.points);
    if (!folder.T_world_body.empty())
      publisher.PublishPose(kGroundTruthChannel, {folder.utimes[i], folder.T_world_body[i]});
    publisher.PublishSweep(kMultiLineChannel, sweep);
  }
}

}  // namespace

std::string CloudImportOptions::Validate() const {
  if (!(rate_hz > 0.0 && rate_hz <= 1e6)) return "--rate: must be in (0, 1e6]";
  if (turn_s && !(*turn_s >= 0.0 && *turn_s <= 10.0)) return "--turn: must be in 0..10";
  if (!lidar.empty() && !NamedMultiLineModel(lidar))
    return fmt::format("--lidar: '{}' is none of vlp16, hdl32e, hdl64e, os1-64", lidar);
  return "";
}

void ImportKitti(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note) {
  ImportFolder(FindKittiScans(options, note), DecodeKittiPoints, options.lidar, publisher);
}

void ImportPcd(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note) {
  const auto decode = [](std::span<const uint8_t> file) { return ToSweepPoints(ParsePcd(file)); };
  ImportFolder(FindClouds(options, ".pcd", note), decode, options.lidar, publisher);
}

void ImportPly(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note) {
  const auto decode = [](std::span<const uint8_t> file) { return ToSweepPoints(ParsePly(file)); };
  ImportFolder(FindClouds(options, ".ply", note), decode, options.lidar, publisher);
}

}  // namespace lcmslam
