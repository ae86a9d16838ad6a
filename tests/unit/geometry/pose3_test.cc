#include "geometry/pose3.h"

#include <utility>

#include <gtest/gtest.h>

#include "geometry/trajectory.h"

namespace lcmslam {
namespace {

TEST(Pose3, PlanarPosesComposeAlike) {
  const Pose2 a(1.0, -2.0, 2.5), b(0.3, 0.4, 1.5);
  const Pose2 planar = a * b;
  const Pose2 spatial = ToPose2(ToPose3(a) * ToPose3(b));
  EXPECT_NEAR(planar.x(), spatial.x(), 1e-12);
  EXPECT_NEAR(planar.y(), spatial.y(), 1e-12);
  EXPECT_NEAR(planar.yaw(), spatial.yaw(), 1e-12);
}

TEST(Pose3, InverseUndoes) {
  const Pose3 T{{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()))};
  EXPECT_LT((T * (T.inverse() * Eigen::Vector3d(4, 5, 6)) - Eigen::Vector3d(4, 5, 6)).norm(), 1e-12);
  EXPECT_NEAR(AngleBetween(T.rotation, Eigen::Quaterniond::Identity()), 2.0, 1e-12);
}

TEST(Reaches, ByLengthOrAngle) {
  for (const auto& [motion, reaches] : {std::pair{Pose2(0.3, 0.4, 0.0), true}, std::pair{Pose2(0.0, 0.0, -0.2), true},
                                        std::pair{Pose2(0.3, 0.3, 0.1), false}}) {
    EXPECT_EQ(Reaches(motion, 0.5, 0.2), reaches);
    EXPECT_EQ(Reaches(ToPose3(motion), 0.5, 0.2 - 1e-12), reaches);
  }
  EXPECT_TRUE(Reaches(Pose2(), 0.0, 1.0)) << "at rest, where any motion will do";
  EXPECT_TRUE(Reaches(Pose3(), 1.0, 0.0));
}

TEST(InterpolateAt, BetweenNeighboursOnly) {
  const Trajectory t = {{1000, ToPose3({0, 0, 0})}, {3000, ToPose3({2, 0, 1})}, {9000, ToPose3({2, 6, 1})}};
  EXPECT_FALSE(InterpolateAt(t, 999));
  EXPECT_FALSE(InterpolateAt(t, 9001));
  EXPECT_FALSE(InterpolateAt(t, 5000, 2000)) << "gap of 6000 us";
  EXPECT_TRUE(InterpolateAt(t, 9000, 2000)) << "exact stamps need no gap";
  const auto p = InterpolateAt(t, 2000, 2000);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->translation.x(), 1.0, 1e-12);
  EXPECT_NEAR(Yaw(p->rotation), 0.5, 1e-12);
  EXPECT_FALSE(InterpolateAt({}, 0));
}

}  // namespace
}  // namespace lcmslam
