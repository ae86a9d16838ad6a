#include "sensors/frame_tree.h"

#include <algorithm>

namespace lcmslam {
namespace {

constexpr double kMoved_m = 1e-3;
constexpr double kMoved_rad = 1e-3;

bool Differ(const Pose3& a, const Pose3& b) {
  return (a.translation - b.translation).norm() > kMoved_m || AngleBetween(a.rotation, b.rotation) > kMoved_rad;
}

}  // namespace

void FrameTree::Add(const std::string& parent, const std::string& child, const Pose3& T_parent_child) {
  if (!T_parent_child.IsRigid() || parent == child) return;
  const auto [joint, is_new] = joints_.try_emplace(child, Joint{parent, T_parent_child});
  if (!is_new && Differ(joint->second.T_parent_child, T_parent_child)) joint->second.moves = true;
}

bool FrameTree::Contains(const std::string& frame) const {
  return joints_.contains(frame) ||
         std::ranges::any_of(joints_, [&](const auto& joint) { return joint.second.parent == frame; });
}

std::string FrameTree::ParentOf(const std::string& frame) const {
  const auto joint = joints_.find(frame);
  return joint == joints_.end() ? "" : joint->second.parent;
}

std::vector<std::string> FrameTree::WayUp(const std::string& frame) const {
  std::vector<std::string> way = {frame};
  for (auto joint = joints_.find(frame); joint != joints_.end(); joint = joints_.find(way.back())) {
    if (std::ranges::find(way, joint->second.parent) != way.end()) break;  // a damaged tree may go in circles
    way.push_back(joint->second.parent);
  }
  return way;
}

std::optional<FrameTree::Mounting> FrameTree::Find(const std::string& base, const std::string& frame) const {
  const std::vector<std::string> from_base = WayUp(base), from_frame = WayUp(frame);
  const auto meeting = std::ranges::find_first_of(from_base, from_frame);
  if (meeting == from_base.end()) return {};
  Mounting mounting;
  const auto climb = [&](const std::vector<std::string>& way) {  // T_meeting_start
    Pose3 T;
    for (const std::string& child : way) {
      if (child == *meeting) break;
      const Joint& joint = joints_.at(child);
      T = joint.T_parent_child * T;
      if (joint.moves) mounting.moving.push_back(child);
    }
    return T;
  };
  const Pose3 T_meeting_base = climb(from_base);
  mounting.T_base_frame = T_meeting_base.inverse() * climb(from_frame);
  return mounting;
}

}  // namespace lcmslam
