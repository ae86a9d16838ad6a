#include "lidar/pose_table.h"

namespace lcmslam {

PoseTable::PoseTable(const TimeSlots& slots, const std::function<Pose3(double dt_us)>& T_map_lidar)
    : entries_(slots.has_times() ? TimeSlots::kSlots : 1) {
  for (size_t slot = 0; slot < entries_.size(); ++slot) {
    const Pose3 pose = T_map_lidar(slots.MiddleUs(static_cast<double>(slot)));
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
