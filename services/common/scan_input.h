#pragma once

#include <functional>
#include <string>

#include "bus/service.h"
#include "common/mounting_gate.h"
#include "geometry/pose2.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

// Finds the planar lidar on the bus and hands over its scans, in order, once it is known how the lidar is mounted.
//
// Channel: the configured one; when that is "", LIDAR_2D or, if a scan comes from another channel first, that one.
// Channels LIDAR_2D_... are further lidars of the same robot and are taken only by name.
// Mounting: the configured pose, else what arrives on <channel>_EXTRINSICS, for which scans wait (MountingGate).
class ScanInput {
 public:
  using ScanHandler = std::function<void(const PlanarScan&)>;
  using MountingHandler = std::function<void(const Pose2& T_body_lidar)>;

  // `on_mounting` is called once, before the first scan, unless the pose was configured.
  ScanInput(std::string channel, bool mounting_configured, MountingHandler on_mounting, ScanHandler on_scan);

  // Takes events of every channel.
  Handled Offer(const Event& event);
  // No more events: hands over what still waits.
  void Flush() { gate_.Flush(); }

  // "" until the first scan.
  const std::string& channel() const { return channel_; }

 private:
  bool Adopt(const Event& event);
  Handled OfferExtrinsics(const Event& event);

  std::string channel_;
  bool automatic_;
  MountingGate<PlanarScan> gate_;
};

}  // namespace lcmslam
