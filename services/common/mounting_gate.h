#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/pose3.h"
#include "geometry/utime.h"

namespace lcmslam {

// Holds back what a lidar measured until it is known how the lidar is mounted: at most 1.5 s of the data's own time,
// then the lidar is taken to sit at the body's origin. Scan has a utime.
template <class Scan>
class MountingGate {
 public:
  using ScanHandler = std::function<void(const Scan&)>;
  using MountingHandler = std::function<void(const Pose3& T_body_lidar)>;

  // `on_mounting` is called once, before the first scan, unless the mounting is known from the start.
  MountingGate(bool known, MountingHandler on_mounting, ScanHandler on_scan)
      : known_(known), on_mounting_(std::move(on_mounting)), on_scan_(std::move(on_scan)) {}

  bool known() const { return known_; }

  void Pass(const Scan& scan) {
    if (known_) return on_scan_(scan);
    waiting_.push_back(scan);
    const int64_t waited_us = UtimeDifference(scan.utime, waiting_.front().utime);
    if (waited_us < 0 || waited_us > kWaitUs || waiting_.size() >= kMaxWaiting) Settle(Pose3());
  }

  // Must not be known yet.
  void Settle(const Pose3& T_body_lidar) {
    known_ = true;
    on_mounting_(T_body_lidar);
    for (const Scan& scan : waiting_) on_scan_(scan);
    waiting_ = {};
  }

  // No more events: hands over what still waits.
  void Flush() {
    if (!known_) Settle(Pose3());
  }

 private:
  static constexpr int64_t kWaitUs = 1'500'000;
  static constexpr size_t kMaxWaiting = 100;  // stamps may stand still

  bool known_;
  MountingHandler on_mounting_;
  ScanHandler on_scan_;
  std::vector<Scan> waiting_;
};

}  // namespace lcmslam
