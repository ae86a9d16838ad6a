#include "lidar/pose_table.h"

namespace lcmslam {

PoseTable::PoseTable(int32_t first_dt_us, const std::function<Pose3(double dt_us)>& T_map_lidar) : entries_(kEntries) {
  if (first_dt_us >= 0) {
    const Pose3 pose = T_map_lidar(0.0);
    std::ranges::fill(entries_, Entry{pose.rotation.toRotationMatrix(), pose.translation});
    return;
  }
  for (int slot = 0; slot < kEntries; ++slot) {
    const Pose3 pose = T_map_lidar(SlotTime(slot, first_dt_us));
    entries_[slot] = {pose.rotation.toRotationMatrix(), pose.translation};
  }
}

int32_t FirstPointTime(const Sweep& sweep) {
  int32_t first_dt_us = 0;
  for (const SweepPoint& point : sweep.points) {
    if (point.IsFinite()) first_dt_us = std::min(first_dt_us, point.dt_us);
  }
  return first_dt_us;
}

}  // namespace lcmslam
