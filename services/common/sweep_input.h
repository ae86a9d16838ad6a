#pragma once

#include <cstdint>
#include <string>

#include "bus/service.h"
#include "bus/sweep_chunks.h"
#include "common/mounting_gate.h"
#include "lidar/sweep.h"

namespace lcmslam {

// Sweeps of one multi-line lidar from point_cloud_chunk_t: put together whatever chunks got lost, in order, and handed
// over once it is known how the lidar is mounted: the configured pose, else what arrives on <channel>_EXTRINSICS, for
// which sweeps wait (MountingGate). Chunks that never came are counted as missing in `health`,
// and sweeps that the lidar itself skipped.
class SweepInput {
 public:
  SweepInput(std::string channel, bool mounting_configured, MountingGate<Sweep>::MountingHandler on_mounting,
             MountingGate<Sweep>::ScanHandler on_sweep, Health& health);

  // Takes events of the channel and its _EXTRINSICS.
  Handled Offer(const Event& event);
  // No more events: hands over what is not whole and what still waits.
  void Flush();

 private:
  Handled OfferExtrinsics(const Event& event);
  void Pass(const std::vector<Sweep>& sweeps);

  std::string channel_;
  MountingGate<Sweep> gate_;
  Health& health_;
  SweepAssembler assembler_;
  int64_t missing_counted_ = 0;
  GapCounter skipped_;
};

}  // namespace lcmslam
