#include "lidar/pose_table.h"

namespace lcmslam {

PoseTable::PoseTable(const TimeSlots& slots, const std::function<Pose3(double dt_us)>& T_map_lidar)
    : entries_(slots.has_times() ? TimeSlots::kSlots : 1) {
  const auto entry_at = [&](size_t slot) -> Entry {
    const Pose3 pose = T_map_lidar(slots.MiddleUs(static_cast<double>(slot)));
    return {pose.rotation.toRotationMatrix(), pose.translation};
  };
  Entry knot = entry_at(0);
  for (size_t first = 0; first < entries_.size(); first += kKnotSlots) {
    const Entry next = entries_.size() > 1 ? entry_at(first + kKnotSlots) : knot;
    const Eigen::Matrix3d R_step = (next.R_map_lidar - knot.R_map_lidar) / kKnotSlots;
    const Eigen::Vector3d t_step = (next.t_map_lidar - knot.t_map_lidar) / kKnotSlots;
    for (size_t i = 0; i < kKnotSlots && first + i < entries_.size(); ++i) {
      const auto steps = static_cast<double>(i);
      entries_[first + i] = {knot.R_map_lidar + steps * R_step, knot.t_map_lidar + steps * t_step};
    }
    knot = next;
  }
}

int32_t FirstPointTime(const Sweep& sweep) {
  int32_t first_dt_us = 0;
  for (const SweepPoint& point : sweep.points) {
    if (point.dt_us < first_dt_us && point.IsFinite()) first_dt_us = point.dt_us;
  }
  return first_dt_us;
}

}  // namespace lcmslam
