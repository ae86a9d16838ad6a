#include "octo3d/point_statistics.h"

#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

std::vector<Eigen::Vector3d> RandomPoints(unsigned seed, int n, const Eigen::Vector3d& extent) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Vector3d> points(n);
  for (Eigen::Vector3d& p : points) {
    p = extent.cwiseProduct(Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
  }
  return points;
}

// Two passes, no running sums.
Eigen::Matrix3d CovarianceOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / points.size();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose() / points.size();
  return covariance;
}

TEST(PointStatistics, AgreesWithTwoPassCovariance) {
  const auto points = RandomPoints(1, 500, {0.1, 0.1, 0.01});
  PointStatistics statistics;
  for (const Eigen::Vector3d& p : points) statistics.Add(p);
  EXPECT_LT((statistics.Covariance() - CovarianceOf(points)).norm(), 1e-15);
}

TEST(PointStatistics, MergingEqualsAddingAboutTheOtherReference) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto a = RandomPoints(seed, 50, {0.1, 0.2, 0.1}), b = RandomPoints(seed + 100, 70, {0.2, 0.1, 0.1});
    const Eigen::Vector3d offset(0.1, -0.1, 0.3);  // reference of b as seen from that of a
    PointStatistics merged, of_b, expected;
    for (const Eigen::Vector3d& p : a) merged.Add(p), expected.Add(p);
    for (const Eigen::Vector3d& p : b) of_b.Add(p), expected.Add(p + offset);
    merged.Merge(of_b, offset);
    EXPECT_EQ(merged.count, expected.count);
    EXPECT_LT((merged.sum - expected.sum).norm(), 1e-12);
    EXPECT_LT((merged.Covariance() - expected.Covariance()).norm(), 1e-13);
  }
}

TEST(PointStatistics, IsThickerAsTheLeastEigenvalueSays) {
  int thicker = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto turn = Eigen::AngleAxisd(0.1 * seed, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Eigen::Matrix3d C = turn * CovarianceOf(RandomPoints(seed, 40, {0.1, 0.2, 0.05})) * turn.transpose();
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues()[0];
    const double limit = 0.05 * 0.05 / 3.0;
    EXPECT_EQ(IsThicker(C, limit), least > limit);
    thicker += least > limit;
  }
  EXPECT_GT(thicker, 20);
  EXPECT_LT(thicker, 180);
  EXPECT_FALSE(IsThicker(Eigen::Matrix3d::Zero(), 0.0));  // a single point
}

TEST(PointStatistics, MergingNothingChangesNothing) {
  PointStatistics statistics;
  statistics.Add({0.1, 0.2, 0.3});
  const PointStatistics before = statistics;
  statistics.Merge(PointStatistics{}, {1.0, 2.0, 3.0});
  EXPECT_EQ(statistics, before);
}

TEST(FitPlane, AgreesWithTheIterativeEigensolver) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const auto points = RandomPoints(seed, 30, {0.2, 0.15, 0.02});
    const Eigen::Quaterniond R = Eigen::Quaterniond(1.0, 0.1 * seed, -0.3, 0.05 * seed).normalized();
    PointStatistics statistics;
    std::vector<Eigen::Vector3d> turned;
    for (const Eigen::Vector3d& p : points) turned.push_back(R * p), statistics.Add(turned.back());
    const PlaneFit fit = FitPlane(statistics);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> oracle(CovarianceOf(turned));
    EXPECT_LT((fit.variances - oracle.eigenvalues()).norm(), 1e-10);
    EXPECT_GT(std::abs(fit.normal.dot(oracle.eigenvectors().col(0))), 1.0 - 1e-9);
  }
}

TEST(FitPlane, OnePointHasNoExtent) {
  PointStatistics statistics;
  statistics.Add({0.3, -0.2, 0.1});
  const PlaneFit fit = FitPlane(statistics);
  EXPECT_LT((fit.mean - Eigen::Vector3d(0.3, -0.2, 0.1)).norm(), 1e-15);
  EXPECT_LT(fit.variances[2], 1e-12);
  EXPECT_TRUE(fit.normal.allFinite());
}

}  // namespace
}  // namespace lcmslam::octo3d
