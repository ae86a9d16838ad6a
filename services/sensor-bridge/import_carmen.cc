#include <cmath>

#include <fmt/format.h>

#include "bus/signals.h"
#include "geometry/trajectory.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"
#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

constexpr int64_t kMaxOdometryGapUs = 500'000;

// What the first pass learns.
struct Survey {
  std::map<std::string, int64_t> scans_by_line;
  Trajectory odometry;  // ODOM lines; stamps strictly increasing
  std::string problem;  // why there are no scans, or not all
};

void Learn(const CarmenRecord& record, Survey& survey) {
  if (const auto* scan = std::get_if<CarmenScan>(&record)) ++survey.scans_by_line[scan->sensor];
  const auto* odometry = std::get_if<CarmenOdometry>(&record);
  if (odometry == nullptr || !odometry->T_odom_robot.IsFinite()) return;
  if (survey.odometry.empty() || odometry->utime > survey.odometry.back().utime)
    survey.odometry.push_back({odometry->utime, ToPose3(odometry->T_odom_robot)});
}

Survey SurveyLog(const CarmenImportOptions& options) {
  Survey survey;
  survey.problem = fmt::format("{}: no laser scans", options.file.string());
  CarmenReader reader(options.file, options.log);
  try {
    while (const auto record = reader.Next()) Learn(*record, survey);
  } catch (const BadInput& error) {  // the second pass comes to the same place
    survey.problem = error.what();
  }
  return survey;
}

// Publishes the records of one log.
class CarmenPublisher {
 public:
  CarmenPublisher(const Survey& survey, std::map<std::string, std::string> channels, int64_t delay_us,
                  SensorPublisher& publisher)
      : survey_(survey), channels_(std::move(channels)), delay_us_(delay_us), publisher_(publisher) {}

  void operator()(const CarmenOdometry& odometry) {
    publisher_.PublishPose(kOdometryChannel, {odometry.utime + delay_us_, ToPose3(odometry.T_odom_robot)});
  }
  void operator()(const CarmenTruth& truth) {
    publisher_.PublishPose(kGroundTruthChannel, {truth.utime + delay_us_, ToPose3(truth.T_world_robot)});
  }
  // Odometry first: a SLAM that gets the scan has it then. Loggers repeat in laser lines the last odometry they know,
  // which may be 0.2 s old; between two ODOM lines it is known better.
  void operator()(const CarmenScan& record) {
    const auto odometry = InterpolateAt(survey_.odometry, record.scan.utime - delay_us_, kMaxOdometryGapUs);
    publisher_.PublishPose(kOdometryChannel, {record.scan.utime, odometry.value_or(ToPose3(record.T_odom_robot))});
    const std::string& channel = channels_.at(record.sensor);
    publisher_.SetMounting(channel, ToPose3(record.T_robot_laser));
    publisher_.PublishScan(channel, record.scan);
  }

 private:
  const Survey& survey_;
  std::map<std::string, std::string> channels_;
  int64_t delay_us_;
  SensorPublisher& publisher_;
};

}  // namespace

std::string CarmenImportOptions::Validate() const {
  if (!(std::abs(scan_delay_s) <= 10.0)) return "--scan-delay: must be within 10 s";
  return log.Validate();
}

void ImportCarmen(const CarmenImportOptions& options, SensorPublisher& publisher, const Note& note) {
  const Survey survey = SurveyLog(options);
  const auto channels = LidarChannels(survey.scans_by_line, options.scan_line, survey.problem);
  for (const auto& [line, channel] : channels) note(fmt::format("{} -> {}", line, channel));
  publisher.ExpectScans(TotalScans(survey.scans_by_line));
  CarmenPublisher publish(survey, channels, std::llround(options.scan_delay_s * 1e6), publisher);
  CarmenReader reader(options.file, options.log);
  for (auto record = reader.Next(); record && !StopRequested(); record = reader.Next()) std::visit(publish, *record);
}

}  // namespace lcmslam
