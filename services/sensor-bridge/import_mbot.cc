#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/errors.h"
#include "bus/log_reader.h"
#include "bus/messages.h"
#include "bus/signals.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"

namespace lcmslam {
namespace {

// What the first pass learns.
struct Survey {
  std::map<std::string, int64_t> scans_by_channel;
  std::set<std::string> other_channels;  // neither scans nor poses
};

Survey SurveyLog(const std::filesystem::path& file) {
  Survey survey;
  LogReader reader(file);
  for (Event event; reader.Next(event);) {
    if (IsScan(event.data)) {
      ++survey.scans_by_channel[event.channel];
    } else if (!IsPose(event.data)) {
      survey.other_channels.insert(event.channel);
    }
  }
  return survey;
}

std::string PoseChannel(const std::string& channel, const MbotImportOptions& options) {
  if (channel == options.odometry_channel) return kOdometryChannel;
  if (channel == options.ground_truth_channel) return kGroundTruthChannel;
  return channel;
}

// False when the event is malformed.
bool Publish(const Event& event, const MbotImportOptions& options, const std::map<std::string, std::string>& lidars,
             SensorPublisher& publisher) {
  if (IsScan(event.data)) {
    const auto scan = DecodeScan(event.data, options.sense);
    if (scan) publisher.PublishScan(lidars.at(event.channel), *scan);
    return scan.has_value();
  }
  if (IsPose(event.data)) {
    const auto pose = DecodePose(event.data);
    if (pose) publisher.PublishPose(PoseChannel(event.channel, options), *pose);
    return pose.has_value();
  }
  return true;
}

}  // namespace

void ImportMbot(const MbotImportOptions& options, SensorPublisher& publisher, const Note& note) {
  const Survey survey = SurveyLog(options.file);
  const auto lidars = LidarChannels(survey.scans_by_channel, options.scan_channel,
                                    fmt::format("{}: no laser scans", options.file.string()));
  for (const auto& [from, to] : lidars) note(fmt::format("{} -> {}", from, to));
  if (!survey.other_channels.empty()) note(fmt::format("not imported: {}", fmt::join(survey.other_channels, ", ")));
  publisher.ExpectScans(TotalScans(survey.scans_by_channel));

  LogReader reader(options.file);
  for (Event event; !StopRequested() && reader.Next(event);) {
    if (!Publish(event, options, lidars, publisher)) {
      throw CommandError(ExitCode::kBadInput,
                         fmt::format("{}: malformed message on {} before offset {}", options.file.string(),
                                     event.channel, reader.position_bytes()));
    }
  }
  if (!reader.DamageReport().empty()) throw CommandError(ExitCode::kBadInput, reader.DamageReport());
}

}  // namespace lcmslam
