#include "lidar/pose_table.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

constexpr int32_t kFirstUs = -100'000;

// A helix: 1 m/s round a circle, turning by 2 rad/s.
Pose3 Helix(double dt_us) {
  const double t = 1e-6 * dt_us;
  const Eigen::Vector3d p(0.5 * std::sin(2.0 * t), 0.5 - 0.5 * std::cos(2.0 * t), 0.3 * t);
  return {p, Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d(0.1, 0.2, 1.0).normalized()))};
}

TEST(PoseTable, BlendsWhatThePoseIsAtEverySlot) {
  const TimeSlots slots(kFirstUs);
  const PoseTable poses(slots, Helix);
  for (int slot = 0; slot < TimeSlots::kSlots; ++slot) {
    SCOPED_TRACE(slot);
    const Pose3 exact = Helix(slots.MiddleUs(slot));
    EXPECT_LT((poses[slot].R_map_lidar - exact.rotation.toRotationMatrix()).norm(), 1e-5);
    EXPECT_LT((poses[slot].t_map_lidar - exact.translation).norm(), 1e-5);
  }
}

TEST(PoseTable, HasOnePoseForASweepWithoutTimes) {
  int calls = 0;
  const PoseTable poses(TimeSlots(0), [&](double dt_us) {
    ++calls;
    EXPECT_EQ(dt_us, 0.0);
    return Helix(40'000);
  });
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE((poses[0] * Eigen::Vector3d(1, 2, 3)).isApprox(Helix(40'000) * Eigen::Vector3d(1, 2, 3)));
}

TEST(TimeSlots, TakesTimesOutsideTheSweepForItsEnds) {
  const TimeSlots slots(kFirstUs);
  EXPECT_EQ(slots.SlotOf(2 * kFirstUs), 0);
  EXPECT_EQ(slots.SlotOf(kFirstUs), 0);
  EXPECT_EQ(slots.SlotOf(0), TimeSlots::kSlots - 1);
  EXPECT_EQ(slots.SlotOf(5), TimeSlots::kSlots - 1);
}

}  // namespace
}  // namespace lcmslam
