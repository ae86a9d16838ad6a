#include "sensors/frame_tree.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lcmslam {
namespace {

Pose3 At(double x, double y, double yaw) { return ToPose3({x, y, yaw}); }

TEST(FrameTree, MountingThroughTheTree) {
  FrameTree tree;
  tree.Add("odom", "base_footprint", At(5, 5, 1));
  tree.Add("base_footprint", "base_link", {{0, 0, 0.1}, Eigen::Quaterniond::Identity()});
  tree.Add("base_link", "mount", At(0.4, 0, std::numbers::pi / 2));
  tree.Add("mount", "laser", At(0.1, 0, 0));
  const auto laser = tree.Find("base_footprint", "laser");
  ASSERT_TRUE(laser);
  EXPECT_LT((laser->T_base_frame.translation - Eigen::Vector3d(0.4, 0.1, 0.1)).norm(), 1e-12);
  EXPECT_NEAR(Yaw(laser->T_base_frame.rotation), std::numbers::pi / 2, 1e-12);
  EXPECT_TRUE(laser->moving.empty());

  const auto back = tree.Find("laser", "base_footprint");
  ASSERT_TRUE(back);
  EXPECT_LT((back->T_base_frame * laser->T_base_frame).translation.norm(), 1e-12);
  const auto self = tree.Find("mount", "mount");
  ASSERT_TRUE(self);
  EXPECT_EQ(self->T_base_frame.translation.norm(), 0.0);
}

TEST(FrameTree, UnconnectedFramesHaveNoMounting) {
  FrameTree tree;
  tree.Add("base", "laser", At(1, 0, 0));
  tree.Add("world", "camera", At(1, 0, 0));
  EXPECT_FALSE(tree.Find("base", "camera"));
  EXPECT_FALSE(tree.Find("base", "unheard"));
  EXPECT_TRUE(tree.Contains("base"));
  EXPECT_FALSE(tree.Contains("unheard"));
  EXPECT_EQ(tree.ParentOf("laser"), "base");
  EXPECT_EQ(tree.ParentOf("base"), "");
}

TEST(FrameTree, MovingJointsAreNamed) {
  FrameTree tree;
  tree.Add("base", "tilt", At(1, 0, 0));
  tree.Add("base", "tilt", At(1.0005, 0, 0));  // less than a millimetre
  tree.Add("tilt", "laser", At(0, 0, 0));
  EXPECT_TRUE(tree.Find("base", "laser")->moving.empty());
  tree.Add("base", "tilt", At(1, 0, 0.2));
  const auto mounting = tree.Find("base", "laser");
  EXPECT_THAT(mounting->moving, testing::ElementsAre("tilt"));
  EXPECT_EQ(mounting->T_base_frame.translation.x(), 1.0) << "the first transform stays";
}

TEST(FrameTree, PassesOverWhatIsNoPoseAndSurvivesCircles) {
  FrameTree tree;
  tree.Add("a", "b", {{NAN, 0, 0}, Eigen::Quaterniond::Identity()});
  tree.Add("a", "c", {{0, 0, 0}, Eigen::Quaterniond(0, 0, 0, 0)});
  tree.Add("d", "d", At(1, 0, 0));
  for (const char* frame : {"b", "c", "d"}) EXPECT_FALSE(tree.Contains(frame)) << frame;
  tree.Add("x", "y", At(1, 0, 0));
  tree.Add("y", "x", At(1, 0, 0));
  EXPECT_FALSE(tree.Find("base", "y"));
  EXPECT_TRUE(tree.Find("x", "y"));
}

}  // namespace
}  // namespace lcmslam
