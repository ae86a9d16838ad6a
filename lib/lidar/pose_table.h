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

// Divides the time of one sweep into equal slots.
class TimeSlots {
 public:
  static constexpr int kSlots = 512;

  // first_dt_us <= 0: the time of the sweep's first point relative to its last. 0: no times, all is slot 0.
  explicit TimeSlots(int32_t first_dt_us)
      : first_dt_us_(first_dt_us), slots_per_us_(first_dt_us < 0 ? kSlots / (1.0 - first_dt_us) : 0.0) {}

  // Times outside the sweep take its ends.
  int SlotOf(int32_t dt_us) const {
    return std::clamp(static_cast<int>((dt_us - first_dt_us_) * slots_per_us_), 0, kSlots - 1);
  }
  // The middle of a slot, relative to the sweep's last point. Also between slots.
  double MiddleUs(double slot) const { return first_dt_us_ * (1.0 - (slot + 0.5) / kSlots); }
  bool has_times() const { return first_dt_us_ < 0; }

 private:
  double first_dt_us_;
  double slots_per_us_;
};

// The poses of a moving lidar at the middle of each time slot of a sweep, so that deskewing a point is a lookup and a
// product. With 512 slots in 0.1 s a turn of 2 rad/s displaces a point at 10 m by at most 2 mm, evenly to both sides.
// Poses are asked for at every kKnotSlots-th slot; the matrices between are their linear blend, off by less than 1e-5.
class PoseTable {
 public:
  struct Entry {
    Eigen::Matrix3d R_map_lidar = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t_map_lidar = Eigen::Vector3d::Zero();

    Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return R_map_lidar * p + t_map_lidar; }
  };

  // T_map_lidar(dt_us): the pose at that time relative to the sweep's last point.
  PoseTable(const TimeSlots& slots, const std::function<Pose3(double dt_us)>& T_map_lidar);

  const Entry& operator[](int slot) const { return entries_[slot]; }
  size_t size() const { return entries_.size(); }

 private:
  static constexpr size_t kKnotSlots = 16;

  std::vector<Entry> entries_;
};

// The age of a sweep's oldest finite point (<= 0; 0 when the sweep is empty or has no times).
int32_t FirstPointTime(const Sweep& sweep);

}  // namespace lcmslam
