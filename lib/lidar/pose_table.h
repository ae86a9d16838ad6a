#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose3.h"
#include "lidar/sweep.h"

namespace lcmslam {

// The poses of a moving lidar sampled at equal steps over one sweep, so that deskewing a point is a lookup and a
// product. With 512 entries over 0.1 s a turn of 2 rad/s displaces a point at 10 m by at most 2 mm, evenly to both
// sides.
class PoseTable {
 public:
  static constexpr int kEntries = 512;
  struct Entry {
    Eigen::Matrix3d R_map_lidar = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t_map_lidar = Eigen::Vector3d::Zero();

    Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return R_map_lidar * p + t_map_lidar; }
  };

  // first_dt_us <= 0: the time of the sweep's first point relative to its last.
  // T_map_lidar(dt_us): the pose at that time; called once per entry.
  PoseTable(int32_t first_dt_us, const std::function<Pose3(double dt_us)>& T_map_lidar);

  // The entry that serves a point of this age; times outside the sweep take its ends.
  static int Slot(int32_t dt_us, int32_t first_dt_us) {
    if (first_dt_us >= 0) return 0;
    const int64_t slot = static_cast<int64_t>(dt_us - first_dt_us) * kEntries / (1 - static_cast<int64_t>(first_dt_us));
    return static_cast<int>(std::clamp<int64_t>(slot, 0, kEntries - 1));
  }
  // The middle of an entry's time, relative to the sweep's last point. All of a sweep without times is at 0.
  static double SlotTime(int slot, int32_t first_dt_us) {
    return first_dt_us >= 0 ? 0.0 : first_dt_us * (1.0 - (slot + 0.5) / kEntries);
  }

  const Entry& operator[](int slot) const { return entries_[slot]; }

 private:
  std::vector<Entry> entries_;
};

// The age of a sweep's oldest finite point (<= 0; 0 when the sweep is empty or has no times).
int32_t FirstPointTime(const Sweep& sweep);

}  // namespace lcmslam
