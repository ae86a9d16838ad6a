#include <numbers>

#include <fmt/format.h>

#include "bus/signals.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"
#include "sensor-bridge/rosbag_survey.h"
#include "sensors/bad_input.h"
#include "sensors/ros_messages.h"
#include "sensors/ros_point_cloud.h"
#include "sensors/rosbag_reader.h"

namespace lcmslam {
namespace {

bool LooksDown(const Pose3& T_base_lidar) { return (T_base_lidar.rotation * Eigen::Vector3d::UnitZ()).z() < 0.0; }

// Publishes the messages of one bag by a plan.
class RosbagPublisher {
 public:
  RosbagPublisher(const RosbagSurvey& survey, const RosbagPlan& plan, SensorPublisher& publisher)
      : plan_(plan), publisher_(publisher) {
    for (const auto& [topic, T_base_sensor] : plan.mountings) {
      const Pose3 turned{{}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()))};
      const bool is_turned = survey.types.at(topic) == kRosLaserScan && LooksDown(T_base_sensor);
      publisher.SetMounting(plan.sensor_channels.at(topic), is_turned ? T_base_sensor * turned : T_base_sensor);
    }
  }

  void Publish(const RosbagMessage& message) {
    const auto& [topic, type] = *message.connection;
    if (const auto channel = plan_.sensor_channels.find(topic); channel != plan_.sensor_channels.end()) {
      if (type == kRosLaserScan) PublishScan(channel->second, message);
      if (type == kRosPointCloud) PublishSweep(channel->second, message);
      if (type == kRosImu) PublishImu(channel->second, message);
    } else if (topic == plan_.odometry_topic) {
      const RosPose pose = DecodeRosPose(message.connection->type, message.data);
      PublishOdometry(pose);
    } else if (topic == plan_.ground_truth_topic) {
      const RosPose pose = DecodeRosPose(message.connection->type, message.data);
      publisher_.PublishPose(kGroundTruthChannel, {pose.utime, pose.T_frame_child});
    } else if (!plan_.odometry_frame.empty() && IsRosTransformsType(message.connection->type)) {
      for (const RosPose& pose : DecodeRosTransforms(message.data)) {
        if (pose.frame == plan_.odometry_frame && pose.child_frame == plan_.odometry_child_frame) PublishOdometry(pose);
      }
    }
  }

 private:
  void PublishScan(const std::string& channel, const RosbagMessage& message) {
    RosLaserScan scan = DecodeRosLaserScan(message.data);
    scan.utime = StampOf(scan.utime, message);
    const auto mounting = plan_.mountings.find(message.connection->topic);
    const bool upside_down = mounting != plan_.mountings.end() && LooksDown(mounting->second);
    publisher_.PublishScan(channel, ToPlanarScan(scan, upside_down));
  }
  void PublishSweep(const std::string& channel, const RosbagMessage& message) {
    RosPointCloud cloud = DecodeRosPointCloud(message.data);
    cloud.utime = StampOf(cloud.utime, message);
    publisher_.PublishSweep(channel, ToSweep(cloud));
  }
  void PublishImu(const std::string& channel, const RosbagMessage& message) {
    ImuSample sample = DecodeRosImu(message.data);
    sample.utime = StampOf(sample.utime, message);
    publisher_.PublishImu(channel, sample);
  }
  // Drivers without a clock leave the stamp 0.
  static int64_t StampOf(int64_t utime, const RosbagMessage& message) {
    return utime == 0 ? message.received_utime : utime;
  }
  void PublishOdometry(const RosPose& pose) {
    publisher_.PublishPose(kOdometryChannel, {pose.utime, pose.T_frame_child * plan_.T_odometry_child_base});
  }

  const RosbagPlan& plan_;
  SensorPublisher& publisher_;
};

}  // namespace

void ImportRosbag(const RosbagImportOptions& options, SensorPublisher& publisher, const Note& note) {
  const RosbagSurvey survey = SurveyRosbag(options.file);
  const RosbagPlan plan = PlanImport(survey, options, note);
  publisher.ExpectScans(TotalScans(survey));
  RosbagPublisher bag(survey, plan, publisher);
  RosbagReader reader(options.file);
  for (auto message = reader.Next(); message && !StopRequested(); message = reader.Next()) {
    try {
      bag.Publish(*message);
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("{}: offset {}: message on {}: {}", options.file.string(), message->offset,
                                 message->connection->topic, error.what()));
    }
  }
}

}  // namespace lcmslam
