// Ten separate sweeps of a VLP-16 in rooms and a corridor, registered in pairs without any guess, both ways.
//   build/bin/octo3d_test --gtest_filter='IndoorPairs.*'
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "octo3d/pipeline.h"
#include "support/real_data.h"

namespace lcmslam::octo3d {
namespace {

constexpr int kSweeps = 10;

Sweep ReadKittiBin(const std::filesystem::path& path, int64_t utime) {
  Sweep sweep{.utime = utime, .points = {}};
  std::ifstream file(path, std::ios::binary);
  float v[4];
  while (file.read(reinterpret_cast<char*>(v), sizeof v)) sweep.points.push_back({.x = v[0], .y = v[1], .z = v[2]});
  return sweep;
}

struct Pair {
  Result forth, back;
  double gap_m = 0.0, gap_rad = 0.0;  // of the way forth and back from standing still
  bool tracked = false;               // both ways
};

Result RegisterTo(const Sweep& map, Sweep sweep) {
  Pipeline pipeline{Options{}};
  (void)pipeline.Process(map);
  sweep.utime += 10'000'000;  // a silence so long that the pose is free
  return pipeline.Process(sweep);
}

Pair RegisterBothWays(const std::vector<Sweep>& sweeps, int from, int to) {
  Pair pair;
  pair.forth = RegisterTo(sweeps[from], sweeps[to]);
  pair.back = RegisterTo(sweeps[to], sweeps[from]);
  const Pose3 gap = pair.forth.T_map_body * pair.back.T_map_body;
  pair.gap_m = gap.translation.norm();
  pair.gap_rad = AngleBetween(gap.rotation, Eigen::Quaterniond::Identity());
  pair.tracked = pair.forth.status == SweepStatus::kTracking && pair.back.status == SweepStatus::kTracking;
  return pair;
}

TEST(IndoorPairs, NeighboursRegisterTheSameBothWays) {
  const std::filesystem::path folder = RealData("vlp16_indoor");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  std::vector<Sweep> sweeps;
  for (int i = 0; i < kSweeps; ++i)
    sweeps.push_back(ReadKittiBin(folder / ("00000" + std::to_string(i) + ".bin"), 1'000'000));

  int consistent = 0;
  std::printf("pair  distance m  inliers     unobservable  there and back m, rad\n");
  for (int from = 0; from < kSweeps; ++from) {
    for (int to = from + 1; to < kSweeps; ++to) {
      const Pair pair = RegisterBothWays(sweeps, from, to);
      if (!pair.tracked) continue;
      std::printf("%d-%d   %5.2f       %.2f, %.2f  %d, %d          %.3f, %.4f\n", from, to,
                  pair.forth.T_map_body.translation.norm(), pair.forth.inlier_ratio, pair.back.inlier_ratio,
                  static_cast<int>(pair.forth.unobservable.cols()), static_cast<int>(pair.back.unobservable.cols()),
                  pair.gap_m, pair.gap_rad);
      consistent += pair.gap_m < 0.1 && pair.gap_rad < 0.05;
    }
  }
  std::printf("of 45 pairs %d close to within 0.1 m and 0.05 rad\n", consistent);
  EXPECT_GE(consistent, 5);
}

}  // namespace
}  // namespace lcmslam::octo3d
