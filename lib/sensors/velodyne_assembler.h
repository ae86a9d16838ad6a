#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lidar/sweep.h"
#include "sensors/velodyne_packet.h"

namespace lcmslam {

// Puts the packets of one Velodyne together to sweeps: one turn each, cut where the head looks along x. The turn in
// which the packets begin is not whole and is left out. Lost packets leave a gap in their sweep; after a second or more
// without packets, or a stamp that goes back, a sweep ends early.
class VelodyneAssembler {
 public:
  // The sweeps that this packet completes. Their utime is received_utime of the very first packet and from there on the
  // sensor's own clock, which counts the microseconds of the hour; where that was set by more than a second, as when it
  // finds GPS, received_utime counts anew. Without received_utime, stamps are by the sensor's clock alone.
  [[nodiscard]] std::vector<Sweep> Add(const VelodynePacket& packet, std::optional<int64_t> received_utime);

  // The begun sweep, when nothing follows; none before the first cut.
  [[nodiscard]] std::optional<Sweep> Finish();

  int64_t packet_utime() const { return packet_utime_; }  // of the first firing of the last packet; 0 before any

 private:
  struct Begun {
    std::vector<SweepPoint> points;
    std::vector<int64_t> utimes;
  };
  int64_t Unwrap(uint32_t stamp_us, std::optional<int64_t> received_utime);

  std::optional<uint32_t> last_stamp_us_;
  std::optional<int64_t> received_utime_;  // of the last packet
  int64_t packet_utime_ = 0;
  double last_azimuth_rad_ = 0.0;
  std::optional<Begun> begun_;
};

}  // namespace lcmslam
