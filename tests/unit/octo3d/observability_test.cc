#include "octo3d/observability.h"

#include <random>

#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

// Information of points on planes: (point, normal) pairs spread over +-3 m.
Matrix6 InformationOf(const std::vector<Eigen::Vector3d>& normals) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  Matrix6 H = Matrix6::Zero();
  for (const Eigen::Vector3d& n : normals) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
      Vector6 J;
      J << n, p.cross(n);
      H += 1e4 * J * J.transpose();
    }
  }
  return H;
}

TEST(FindUnobservable, ARoomHoldsNothing) {
  const Observability o = FindUnobservable(InformationOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1e-3);
  EXPECT_EQ(o.held.cols(), 0);
  EXPECT_EQ(o.projection, Matrix6::Identity());
}

TEST(FindUnobservable, ACorridorHoldsItsLength) {
  const Matrix6 H = InformationOf({{0, 1, 0}, {0, 0, 1}});
  const Observability o = FindUnobservable(H, 1e-3);
  ASSERT_EQ(o.held.cols(), 1);
  EXPECT_GT(std::abs(o.held(0, 0)), 0.999);
  // No information is left along it, and all across it.
  const Matrix6 kept = o.projection * H * o.projection.transpose();
  EXPECT_LT(kept(0, 0), 1e-6 * H.trace());
  EXPECT_NEAR(kept(1, 1), H(1, 1), 1e-6 * H.trace());
}

TEST(FindUnobservable, OnePlaneHoldsThree) {
  const Observability o = FindUnobservable(InformationOf({{0, 0, 1}}), 1e-3);
  EXPECT_EQ(o.held.cols(), 3);  // x, y, yaw
  EXPECT_LT(o.held.row(2).norm(), 1e-3);
}

TEST(FindUnobservable, NothingSeenHoldsNothing) { EXPECT_EQ(FindUnobservable(Matrix6::Zero(), 1e-3).held.cols(), 0); }

}  // namespace
}  // namespace lcmslam::octo3d
