#include "octo3d/thinning.h"

#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

std::vector<int> Thinned(int size, size_t max_size) {
  std::vector<int> elements(static_cast<size_t>(size));
  std::iota(elements.begin(), elements.end(), 0);
  Thin(elements, max_size);
  return elements;
}

TEST(Thin, LeavesWhatFits) {
  EXPECT_TRUE(Thinned(0, 10).empty());
  EXPECT_EQ(Thinned(10, 10).size(), 10U);
}

TEST(Thin, KeepsEveryRingAndEveryTimeAlike) {
  for (const int size : {20'001, 30'000, 40'000, 80'000, 160'000, 320'000}) {
    SCOPED_TRACE(size);
    const std::vector<int> kept = Thinned(size, 20'000);
    EXPECT_EQ(kept.front(), 0);
    EXPECT_NEAR(static_cast<double>(kept.size()), 20'000.0, 200.0);
    for (const int rings : {16, 32, 64}) {
      std::vector<int> of_ring(static_cast<size_t>(rings));
      for (const int i : kept) ++of_ring[static_cast<size_t>(i % rings)];
      for (const int count : of_ring) EXPECT_NEAR(count * rings, 20'000, 1'500) << rings;
    }
    std::array<int, 10> of_time{};
    for (const int i : kept) ++of_time[static_cast<size_t>(int64_t{i} * 10 / size)];
    for (const int count : of_time) EXPECT_NEAR(count, 2'000, 40);
  }
}

}  // namespace
}  // namespace lcmslam::octo3d
