#pragma once

#include <map>
#include <optional>
#include <string>

#include "sensor-bridge/log_import.h"
#include "sensors/frame_tree.h"

namespace lcmslam {

// What a bag holds, learnt in one pass.
struct RosbagSurvey {
  std::map<std::string, std::string> types;         // of every topic
  std::map<std::string, int64_t> messages;          // of every topic
  std::map<std::string, std::string> frames;        // of every LaserScan topic: its first frame
  std::map<std::string, std::string> child_frames;  // of every pose topic: its first child frame
  FrameTree tree;
  std::string problem;  // why there are no scans, or not all
};
// The topics of sensor_msgs/LaserScan with their numbers of messages.
[[nodiscard]] std::map<std::string, int64_t> ScanTopics(const RosbagSurvey& survey);
[[nodiscard]] RosbagSurvey SurveyRosbag(const std::filesystem::path& file);

// What is imported as what.
struct RosbagPlan {
  std::map<std::string, std::string> lidar_channels;  // by LaserScan topic
  std::map<std::string, Pose3> mountings;             // T_base_lidar by topic; none where tf does not say
  std::string base_frame;                             // "" where nothing names one
  std::string odometry_topic;                         // "": from tf
  std::string odometry_frame;                         // tf: the parent of `odometry_child_frame`; "": no odometry
  std::string odometry_child_frame;
  Pose3 T_odometry_child_base;
  std::string ground_truth_topic;  // "": none
};
// Throws CommandError (kUsage) when the options name topics or frames that the bag does not have.
[[nodiscard]] RosbagPlan PlanImport(const RosbagSurvey& survey, const RosbagImportOptions& options, const Note& note);

}  // namespace lcmslam
