#include "octo3d/patches.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lcmslam::octo3d {
namespace {

Sweep Wall(double x_m, int n, int32_t span_us) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> uniform(-2.0F, 2.0F);
  Sweep sweep{.utime = 1000000, .points = {}};
  for (int i = 0; i < n; ++i) {
    sweep.points.push_back({.x = static_cast<float>(x_m),
                            .y = uniform(random),
                            .z = uniform(random),
                            .dt_us = static_cast<int32_t>(int64_t{span_us} * (i - n + 1) / n)});
  }
  return sweep;
}

double TotalCount(const std::vector<Patch>& patches) {
  double count = 0.0;
  for (const Patch& patch : patches) count += patch.count;
  return count;
}

TEST(MakePatches, APlaneGivesCoarsePatchesThatHoldEveryPoint) {
  PatchOptions options;
  options.time_slices = 1;
  const auto patches = MakePatches(Wall(3.05, 20000, 0), options, 0.03);
  EXPECT_EQ(TotalCount(patches), 20000);
  const double cells = std::pow(4.0 / options.cell_m + 1.0, 2);
  EXPECT_LE(patches.size(), cells);
  for (const Patch& patch : patches) EXPECT_NEAR(patch.mean.x(), 3.05, 1e-5);
}

TEST(MakePatches, ACornerIsSplit) {
  Sweep corner = Wall(3.05, 10000, 0);
  for (const SweepPoint& p : Wall(3.05, 10000, 0).points)
    corner.points.push_back({.x = 3.05F + p.y / 2, .y = p.z, .z = 0.02F});
  PatchOptions options;
  options.time_slices = 1;
  for (const Patch& patch : MakePatches(corner, options, 0.03)) {
    const double to_wall = std::abs(patch.mean.x() - 3.05), to_floor = std::abs(patch.mean.z() - 0.02);
    EXPECT_LT(std::min(to_wall, to_floor), options.cell_m / 4) << "at most half of a finest cell off both";
  }
}

TEST(MakePatches, APatchStaysWithinItsTime) {
  // The same wall seen at the sweep's start and again at its end.
  Sweep sweep = Wall(3.05, 4000, 10000);
  for (SweepPoint& p : sweep.points) p.dt_us -= 90000;
  for (const SweepPoint& p : Wall(3.05, 4000, 10000).points) sweep.points.push_back(p);
  for (const Patch& patch : MakePatches(sweep, PatchOptions{}, 0.03)) {
    EXPECT_TRUE(patch.slot < 60 || patch.slot > 450) << patch.slot;
  }
}

TEST(MakePatches, SkipsWhatIsUseless) {
  Sweep sweep{.utime = 1, .points = {}};
  EXPECT_TRUE(MakePatches(sweep, PatchOptions{}, 0.03).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  sweep.points = {{.x = nan}, {.x = inf}, {.x = 0.1F}, {.x = 1e6F}, {.x = 5.0F, .y = -inf}};
  EXPECT_TRUE(MakePatches(sweep, PatchOptions{}, 0.03).empty());
  sweep.points.push_back({.x = 5.0F});
  const auto one = MakePatches(sweep, PatchOptions{}, 0.03);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].count, 1.0F);
}

TEST(MakePatches, ThinsEvenly) {
  PatchOptions options;
  options.max_patches = 100;
  const auto patches = MakePatches(Wall(3.05, 20000, 100000), options, 0.03);
  ASSERT_EQ(patches.size(), 100U);
  EXPECT_LT(patches.front().slot, 64);
  EXPECT_GT(patches.back().slot, 448);
}

}  // namespace
}  // namespace lcmslam::octo3d
