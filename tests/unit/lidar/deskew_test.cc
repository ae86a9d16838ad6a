#include "lidar/deskew.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(ReturnsInBody, KeepsFiniteReturnsWithinLimits) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const PlanarScan scan{.utime = 5,
                        .beams = {{1.0F, 0.0F, -20},
                                  {nan, 0.0F, 0},
                                  {inf, 0.0F, 0},
                                  {0.0F, 0.0F, 0},
                                  {-1.0F, 0.0F, 0},
                                  {0.05F, 0.0F, 0},
                                  {9.0F, 0.0F, 0},
                                  {1.0F, nan, 0},
                                  {2.0F, static_cast<float>(DegToRad(90.0)), 0}}};
  const auto points = ReturnsInBody(scan, Pose2(0.5, 0.0, DegToRad(90.0)), 0.1, 8.0);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_TRUE(points[0].p_body.isApprox(Vector2d(0.5, 1.0), 1e-6));
  EXPECT_DOUBLE_EQ(points[0].dt_s, -20e-6);
  EXPECT_TRUE(points[1].p_body.isApprox(Vector2d(-1.5, 0.0), 1e-6));
  EXPECT_DOUBLE_EQ(points[1].range_m, 2.0);
  EXPECT_TRUE(ReturnsInBody({}, Pose2(), 0.1, 8.0).empty());
}

TEST(Deskew, IsTheExponentialOfTheTwist) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double turn_rate : {0.0, 1e-9, 0.5, 3.0, 60.0}) {
    const Vector3d twist(2.0 * unit(random), unit(random), turn_rate);
    std::vector<ScanPoint> points;
    for (int i = 0; i < 200; ++i) points.push_back({{5.0 * unit(random), 5.0 * unit(random)}, 1.0, 0.1 * unit(random)});
    points.push_back({{1.0, 2.0}, 1.0, 0.0});
    std::vector<Vector2d> p_end;
    Deskew(points, twist, &p_end);
    ASSERT_EQ(p_end.size(), points.size());
    for (size_t i = 0; i < points.size(); ++i) {
      EXPECT_LT((p_end[i] - Pose2::Exp(twist * points[i].dt_s) * points[i].p_body).norm(), 1e-9) << turn_rate;
    }
  }
}

// A wall point watched by a moving body: every beam of the sweep must come out at the same place.
TEST(Deskew, StillPointStaysStill) {
  const Vector3d twist(0.8, 0.1, 1.5);
  const Vector2d p_end_true(2.0, -1.0);
  std::vector<ScanPoint> points;
  for (int i = 0; i < 100; ++i) {
    const double dt_s = -0.001 * i;
    points.push_back({Pose2::Exp(twist * dt_s).inverse() * p_end_true, 1.0, dt_s});
  }
  std::vector<Vector2d> p_end;
  Deskew(points, twist, &p_end);
  for (const Vector2d& p : p_end) EXPECT_TRUE(p.isApprox(p_end_true, 1e-9));
}

TEST(Deskew, NoPoints) {
  std::vector<Vector2d> p_end(3);
  Deskew({}, Vector3d::Zero(), &p_end);
  EXPECT_TRUE(p_end.empty());
}

}  // namespace
}  // namespace lcmslam
