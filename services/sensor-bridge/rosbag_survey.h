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
  std::map<std::string, std::string> frames;        // of every sensor's topic: its first frame
  std::map<std::string, std::string> child_frames;  // of every pose topic: its first child frame
  FrameTree tree;
  std::string problem;  // why there are no scans or sweeps, or not all
};
inline constexpr const char* kRosLaserScan = "sensor_msgs/LaserScan";
inline constexpr const char* kRosPointCloud = "sensor_msgs/PointCloud2";
inline constexpr const char* kRosImu = "sensor_msgs/Imu";

// Messages on all LaserScan and PointCloud2 topics.
[[nodiscard]] int64_t TotalScans(const RosbagSurvey& survey);
[[nodiscard]] RosbagSurvey SurveyRosbag(const std::filesystem::path& file);

// What is imported as what.
struct RosbagPlan {
  std::map<std::string, std::string> sensor_channels;  // by topic
  std::map<std::string, Pose3> mountings;              // T_base_sensor by topic; none where tf does not say
  std::string base_frame;                              // "" where nothing names one
  std::string odometry_topic;                          // "": from tf
  std::string odometry_frame;                          // tf: the parent of `odometry_child_frame`; "": no odometry
  std::string odometry_child_frame;
  Pose3 T_odometry_child_base;
  std::string ground_truth_topic;  // "": none
};
// Throws CommandError: kUsage when the options name topics or frames that the bag does not have, kBadInput when it has
// no lidar.
[[nodiscard]] RosbagPlan PlanImport(const RosbagSurvey& survey, const RosbagImportOptions& options, const Note& note);

}  // namespace lcmslam
