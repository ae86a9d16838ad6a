#include "trajectory/pose_errors.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "unit/trajectory/matrix_oracle.h"
#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using testing::Angle;
using testing::Matrix;
using testing::Translation;

struct Expected {
  std::vector<double> translation_m, rotation_rad;
};

void ExpectNear(const PoseErrors& actual, const Expected& expected) {
  ASSERT_EQ(actual.translation_m.size(), expected.translation_m.size());
  ASSERT_EQ(actual.rotation_rad.size(), expected.rotation_rad.size());
  for (size_t i = 0; i < expected.translation_m.size(); ++i) {
    EXPECT_NEAR(actual.translation_m[i], expected.translation_m[i], 1e-9) << i;
    EXPECT_NEAR(actual.rotation_rad[i], expected.rotation_rad[i], 1e-9) << i;
  }
}

// (R_i^-1 R_j)^-1 (E_i^-1 E_j), as the definition reads.
Eigen::Matrix4d RelativeError(const PosePair& i, const PosePair& j) {
  const Eigen::Matrix4d reference = Matrix(i.reference).inverse() * Matrix(j.reference);
  const Eigen::Matrix4d estimate = Matrix(i.estimate).inverse() * Matrix(j.estimate);
  return reference.inverse() * estimate;
}

std::vector<double> Lengths(std::span<const PosePair> pairs) {
  std::vector<double> lengths = {0.0};
  for (size_t k = 1; k < pairs.size(); ++k) {
    lengths.push_back(lengths.back() + (Matrix(pairs[k].reference) - Matrix(pairs[k - 1].reference)).col(3).norm());
  }
  return lengths;
}

// Looks at every pair (i, j). position: of each pose, s or m.
Expected AllRelativeErrors(std::span<const PosePair> pairs, const std::vector<double>& position, double step) {
  Expected expected;
  for (size_t i = 0; i < pairs.size(); ++i) {
    size_t nearest = i;
    double distance = std::numeric_limits<double>::infinity();
    for (size_t j = i + 1; j < pairs.size(); ++j) {
      const double d = std::abs(position[j] - (position[i] + step));
      if (d >= distance) continue;
      distance = d;
      nearest = j;
    }
    if (nearest == i || distance > kStepTolerance * step) continue;
    const Eigen::Matrix4d error = RelativeError(pairs[i], pairs[nearest]);
    expected.translation_m.push_back(Translation(error));
    expected.rotation_rad.push_back(Angle(error));
  }
  return expected;
}

TEST(AbsoluteErrors, AgreeWithMatrices) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const auto pairs = testing::NoisyPairs(100, seed, 0.2);
    Expected expected;
    for (const PosePair& p : pairs) {
      expected.translation_m.push_back((Matrix(p.reference) - Matrix(p.estimate)).topRightCorner<3, 1>().norm());
      expected.rotation_rad.push_back(Angle(Matrix(p.reference).inverse() * Matrix(p.estimate)));
    }
    ExpectNear(AbsoluteErrors(pairs), expected);
  }
}

TEST(RelativeErrors, AgreeWithSearchOverAllPairs) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    auto pairs = testing::NoisyPairs(300, seed, 0.05);
    pairs.erase(pairs.begin() + 100, pairs.begin() + 130);  // a gap
    std::vector<double> times_us;
    for (const PosePair& p : pairs) times_us.push_back(static_cast<double>(p.utime));
    for (const double step_s : {0.1, 1.0, 5.0, 100.0}) {
      SCOPED_TRACE(step_s);
      ExpectNear(RelativeErrorsOverTime(pairs, step_s), AllRelativeErrors(pairs, times_us, step_s * 1e6));
    }
    for (const double step_m : {0.5, 1.0, 2.0, 5.0, 1000.0}) {
      SCOPED_TRACE(step_m);
      ExpectNear(RelativeErrorsOverDistance(pairs, PathLengths(pairs), step_m),
                 AllRelativeErrors(pairs, Lengths(pairs), step_m));
    }
  }
}

TEST(RelativeErrors, DoNotDependOnTheFrames) {
  auto pairs = testing::NoisyPairs(200, 3, 0.05);
  const PoseErrors before = RelativeErrorsOverTime(pairs, 1.0);
  testing::Noise noise(1);
  const Pose3 T_a = testing::RandomPose(noise, 100.0), T_b = testing::RandomPose(noise, 100.0);
  for (PosePair& p : pairs) p = {p.utime, T_a * p.estimate, T_b * p.reference};
  const PoseErrors after = RelativeErrorsOverTime(pairs, 1.0);
  ExpectNear(after, {before.translation_m, before.rotation_rad});
  EXPECT_FALSE(before.translation_m.empty());
}

TEST(RelativeErrors, StandingStillHasNoDistance) {
  const std::vector<PosePair> still(50);
  EXPECT_TRUE(RelativeErrorsOverDistance(still, PathLengths(still), 0.5).translation_m.empty());
  EXPECT_TRUE(RelativeErrorsOverDistance({}, {}, 0.5).translation_m.empty());
  EXPECT_TRUE(RelativeErrorsOverTime({still.data(), 1}, 0.5).translation_m.empty());
}

TEST(KittiSegmentErrors, AgreeWithTheDevkitsLoops) {
  testing::Noise noise(11);
  std::vector<PosePair> pairs;
  Pose3 reference, estimate;
  for (int k = 0; k < 1200; ++k) {
    pairs.push_back({k * 100'000, estimate, reference});
    const Pose3 step{{0.8, noise.Gauss(0.05), noise.Gauss(0.02)}, testing::RotationVector(noise.Gauss3(0.03))};
    reference = reference * step;
    estimate = estimate * step * Pose3{noise.Gauss3(0.01), testing::RotationVector(noise.Gauss3(0.001))};
  }
  const std::vector<double> position = Lengths(pairs);
  std::vector<double> translation, rotation;
  for (size_t first = 0; first < pairs.size(); first += 10) {
    for (int length = 100; length <= 800; length += 100) {
      size_t last = first;
      while (last < pairs.size() && position[last] <= position[first] + length) ++last;
      if (last == pairs.size()) continue;
      const Eigen::Matrix4d error = RelativeError(pairs[first], pairs[last]);
      translation.push_back(Translation(error) / length);
      rotation.push_back(Angle(error) / length);
    }
  }
  const KittiErrors actual = KittiSegmentErrors(pairs, PathLengths(pairs));
  ExpectNear({actual.translation_ratio, actual.rotation_rad_per_m}, {translation, rotation});
  EXPECT_GT(translation.size(), 300u);
  const std::span short_run(pairs.data(), 100);
  EXPECT_TRUE(KittiSegmentErrors(short_run, PathLengths(short_run)).translation_ratio.empty()) << "80 m";
}

TEST(DriftPerMetre, IsTheErrorFromEndToEndOverTheLength) {
  const auto pairs = testing::NoisyPairs(100, 12, 0.05);
  const Drift drift = DriftPerMetre(pairs, PathLengths(pairs));
  const double length_m = Lengths(pairs).back();
  const Eigen::Matrix4d error = RelativeError(pairs.front(), pairs.back());
  EXPECT_NEAR(drift.path_length_m, length_m, 1e-9);
  EXPECT_NEAR(drift.translation_m_per_m, Translation(error) / length_m, 1e-9);
  EXPECT_NEAR(drift.rotation_rad_per_m, Angle(error) / length_m, 1e-9);
  EXPECT_TRUE(std::isnan(DriftPerMetre({}, {}).translation_m_per_m));
  const std::vector<PosePair> still(5);
  EXPECT_TRUE(std::isnan(DriftPerMetre(still, PathLengths(still)).translation_m_per_m));
}

}  // namespace
}  // namespace lcmslam
