#include "evaluator/pair_file.h"

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

std::vector<PosePair> SomePairs(int64_t count) {
  std::vector<PosePair> pairs;
  for (int64_t k = 0; k < count; ++k) {
    const double x = static_cast<double>(k) / 7.0;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(x, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
    pairs.push_back({INT64_MAX / 3 - k, {{x, -x, 1.0 / 3.0}, turn}, {{0.1, x, x * x}, turn.inverse()}});
  }
  return pairs;
}

void ExpectSame(const std::vector<PosePair>& a, const std::vector<PosePair>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].utime, b[i].utime);
    EXPECT_EQ(a[i].estimate.translation, b[i].estimate.translation);
    EXPECT_EQ(a[i].estimate.rotation.coeffs(), b[i].estimate.rotation.coeffs());
    EXPECT_EQ(a[i].reference.translation, b[i].reference.translation);
    EXPECT_EQ(a[i].reference.rotation.coeffs(), b[i].reference.rotation.coeffs());
  }
}

TEST(PairFile, GivesBackEveryBit) {
  const std::vector<PosePair> pairs = SomePairs(1000);
  PairFile file;
  for (size_t i = 0; i < pairs.size(); i += 10) file.Add({pairs.data() + i, 10});
  ExpectSame(file.ReadAll().value(), pairs);
}

TEST(PairFile, EmptyAndBegunAnew) {
  PairFile file;
  EXPECT_TRUE(file.ReadAll().value().empty());
  file.Add(SomePairs(20));
  file.Clear();
  EXPECT_TRUE(file.ReadAll().value().empty());
  file.Add(SomePairs(3));
  ExpectSame(file.ReadAll().value(), SomePairs(3));
}

}  // namespace
}  // namespace lcmslam
