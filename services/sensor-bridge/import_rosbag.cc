#include <numbers>

#include <fmt/format.h>

#include "bus/signals.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensor-bridge/log_import.h"
#include "sensor-bridge/rosbag_survey.h"
#include "sensors/bad_input.h"
#include "sensors/ros_messages.h"
#include "sensors/rosbag_reader.h"

namespace lcmslam {
namespace {

bool LooksDown(const Pose3& T_base_lidar) { return (T_base_lidar.rotation * Eigen::Vector3d::UnitZ()).z() < 0.0; }

// Publishes the messages of one bag by a plan.
class RosbagPublisher {
 public:
  RosbagPublisher(const RosbagPlan& plan, SensorPublisher& publisher) : plan_(plan), publisher_(publisher) {
    for (const auto& [topic, T_base_lidar] : plan.mountings) {
      const Pose3 turned{{}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()))};
      publisher.SetMounting(plan.lidar_channels.at(topic),
                            LooksDown(T_base_lidar) ? T_base_lidar * turned : T_base_lidar);
    }
  }

  void Publish(const RosbagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (plan_.lidar_channels.contains(topic)) {
      PublishScan(message);
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
  void PublishScan(const RosbagMessage& message) {
    const std::string& topic = message.connection->topic;
    RosLaserScan scan = DecodeRosLaserScan(message.data);
    if (scan.utime == 0) scan.utime = message.received_utime;  // a driver without a clock
    const auto mounting = plan_.mountings.find(topic);
    const bool upside_down = mounting != plan_.mountings.end() && LooksDown(mounting->second);
    publisher_.PublishScan(plan_.lidar_channels.at(topic), ToPlanarScan(scan, upside_down));
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
  publisher.ExpectScans(TotalScans(ScanTopics(survey)));
  RosbagPublisher bag(plan, publisher);
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
