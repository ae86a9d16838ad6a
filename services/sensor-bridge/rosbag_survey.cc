#include "sensor-bridge/rosbag_survey.h"

#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/errors.h"
#include "sensor-bridge/lidar_channels.h"
#include "sensors/bad_input.h"
#include "sensors/ros_messages.h"
#include "sensors/rosbag_reader.h"

namespace lcmslam {
namespace {

constexpr const char* kOdometry = "nav_msgs/Odometry";

bool IsSensorType(const std::string& type) {
  return type == kRosLaserScan || type == kRosPointCloud || type == kRosImu;
}

void Learn(const RosbagMessage& message, RosbagSurvey& survey) {
  const auto& [topic, type] = *message.connection;
  survey.types[topic] = type;
  ++survey.messages[topic];
  if (IsSensorType(type) && !survey.frames.contains(topic)) {
    ByteReader reader(message.data);
    survey.frames[topic] = GetRosHeader(reader).frame;
  } else if (IsRosPoseType(type) && !survey.child_frames.contains(topic)) {
    survey.child_frames[topic] = DecodeRosPose(type, message.data).child_frame;
  } else if (IsRosTransformsType(type)) {
    for (const RosPose& pose : DecodeRosTransforms(message.data))
      survey.tree.Add(pose.frame, pose.child_frame, pose.T_frame_child);
  }
}

// The topics of the types for which `wanted` holds, with their counts.
template <class Wanted>
std::map<std::string, int64_t> TopicsWhere(const RosbagSurvey& survey, const Wanted& wanted) {
  std::map<std::string, int64_t> topics;
  for (const auto& [topic, type] : survey.types) {
    if (wanted(topic, type)) topics[topic] = survey.messages.at(topic);
  }
  return topics;
}

std::map<std::string, int64_t> TopicsOf(const RosbagSurvey& survey, const std::string& wanted) {
  return TopicsWhere(survey, [&](const std::string&, const std::string& type) { return type == wanted; });
}

std::string Busiest(const std::map<std::string, int64_t>& topics) {
  const auto most = std::ranges::max_element(topics, {}, [](const auto& topic) { return topic.second; });
  return most == topics.end() ? "" : most->first;
}

bool NamedGroundTruth(const std::string& topic) {
  static const std::regex kName("(^|.*/|.*_)(ground_?truth|gt|true_pose|mocap|vicon|optitrack|qualisys)(_.*|/.*|$)",
                                std::regex::icase);
  return std::regex_match(topic, kName);
}

void RequirePoseTopic(const RosbagSurvey& survey, const std::string& topic) {
  if (!topic.empty() && !survey.child_frames.contains(topic))
    throw CommandError(ExitCode::kUsage, fmt::format("no poses on topic '{}'", topic));
}

std::string ChooseGroundTruth(const RosbagSurvey& survey, const std::string& chosen) {
  RequirePoseTopic(survey, chosen);
  if (!chosen.empty()) return chosen;
  return Busiest(TopicsWhere(survey, [](const std::string& topic, const std::string& type) {
    return IsRosPoseType(type) && NamedGroundTruth(topic);
  }));
}

std::string ChooseOdometryTopic(const RosbagSurvey& survey, const std::string& chosen, const std::string& truth_topic) {
  RequirePoseTopic(survey, chosen);
  if (!chosen.empty()) return chosen;
  return Busiest(TopicsWhere(survey, [&](const std::string& topic, const std::string& type) {
    return type == kOdometry && topic != truth_topic && !NamedGroundTruth(topic);
  }));
}

std::string ChooseBaseFrame(const RosbagSurvey& survey, const std::string& chosen, const std::string& odometry_child) {
  if (!chosen.empty() && !survey.tree.Contains(chosen))
    throw CommandError(ExitCode::kUsage, fmt::format("no frame '{}' on tf", chosen));
  for (const std::string& frame : {chosen, odometry_child, std::string("base_footprint"), std::string("base_link")}) {
    if (survey.tree.Contains(frame)) return frame;
  }
  return "";
}

// Odometry on tf: the first moving step on the way up from the base, unless it comes from a map.
void PlanOdometryFromTf(const RosbagSurvey& survey, RosbagPlan& plan) {
  std::string child = plan.base_frame;
  for (std::string parent = survey.tree.ParentOf(child); !parent.empty(); parent = survey.tree.ParentOf(child)) {
    if (parent == "odom" || parent.ends_with("/odom")) {
      plan.odometry_frame = parent;
      plan.odometry_child_frame = child;
      return;
    }
    if (parent == plan.base_frame) return;  // a damaged tree may go in circles
    child = parent;
  }
}

std::map<std::string, std::string> PlanChannels(const RosbagSurvey& survey, const RosbagImportOptions& options) {
  std::map<std::string, std::string> channels =
      SensorChannels(TopicsOf(survey, kRosLaserScan), options.scan_topic, kMainLidarChannel);
  channels.merge(SensorChannels(TopicsOf(survey, kRosPointCloud), options.cloud_topic, kMultiLineChannel));
  if (channels.empty()) throw CommandError(ExitCode::kBadInput, survey.problem);
  channels.merge(SensorChannels(TopicsOf(survey, kRosImu), options.imu_topic, kImuChannel));
  return channels;
}

void PlanMountings(const RosbagSurvey& survey, RosbagPlan& plan, const Note& note) {
  for (const auto& [topic, frame] : survey.frames) {
    const auto mounting = survey.tree.Find(plan.base_frame, frame);
    const std::string line = fmt::format("{} -> {}: ", topic, plan.sensor_channels.at(topic));
    if (!mounting) {
      note(fmt::format("{}no tf between '{}' and '{}', mounting unknown", line, plan.base_frame, frame));
      continue;
    }
    plan.mountings[topic] = mounting->T_base_frame;
    const Eigen::Vector3d& at = mounting->T_base_frame.translation;
    note(fmt::format("{}at ({:.3f}, {:.3f}, {:.3f}) m, yaw {:.3f} rad in {}{}", line, at.x(), at.y(), at.z(),
                     Yaw(mounting->T_base_frame.rotation), plan.base_frame,
                     mounting->moving.empty()
                         ? ""
                         : fmt::format("; {} moves, its first pose is taken", fmt::join(mounting->moving, ", "))));
  }
}

}  // namespace

RosbagSurvey SurveyRosbag(const std::filesystem::path& file) {
  RosbagSurvey survey;
  survey.problem = fmt::format("{}: no laser scans or point clouds", file.string());
  RosbagReader reader(file);
  try {
    while (const auto message = reader.Next()) Learn(*message, survey);
  } catch (const BadInput& error) {  // the second pass comes to the same place
    survey.problem = error.what();
  }
  return survey;
}

int64_t TotalScans(const RosbagSurvey& survey) {
  return TotalScans(TopicsOf(survey, kRosLaserScan)) + TotalScans(TopicsOf(survey, kRosPointCloud));
}

RosbagPlan PlanImport(const RosbagSurvey& survey, const RosbagImportOptions& options, const Note& note) {
  RosbagPlan plan;
  plan.sensor_channels = PlanChannels(survey, options);
  plan.ground_truth_topic = ChooseGroundTruth(survey, options.ground_truth_topic);
  plan.odometry_topic = ChooseOdometryTopic(survey, options.odometry_topic, plan.ground_truth_topic);
  if (!plan.odometry_topic.empty()) plan.odometry_child_frame = survey.child_frames.at(plan.odometry_topic);
  plan.base_frame = ChooseBaseFrame(survey, options.base_frame, plan.odometry_child_frame);
  if (plan.odometry_topic.empty()) PlanOdometryFromTf(survey, plan);
  if (const auto step = survey.tree.Find(plan.odometry_child_frame, plan.base_frame))
    plan.T_odometry_child_base = step->T_base_frame;
  PlanMountings(survey, plan, note);
  if (!plan.odometry_topic.empty()) note(fmt::format("{} -> {}", plan.odometry_topic, kOdometryChannel));
  if (!plan.odometry_frame.empty())
    note(fmt::format("tf {} -> {}: {}", plan.odometry_frame, plan.odometry_child_frame, kOdometryChannel));
  if (!plan.ground_truth_topic.empty()) note(fmt::format("{} -> {}", plan.ground_truth_topic, kGroundTruthChannel));
  return plan;
}

}  // namespace lcmslam
