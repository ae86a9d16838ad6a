#include "common/sweep_input.h"

#include <algorithm>
#include <utility>

#include <lcmslam/point_cloud_chunk_t.hpp>

#include "bus/messages.h"

namespace lcmslam {

SweepInput::SweepInput(std::string channel, bool mounting_configured, MountingGate<Sweep>::MountingHandler on_mounting,
                       MountingGate<Sweep>::ScanHandler on_sweep, Health& health)
    : channel_(std::move(channel)),
      gate_(mounting_configured, std::move(on_mounting), std::move(on_sweep)),
      health_(health) {}

Handled SweepInput::Offer(const Event& event) {
  if (event.channel != channel_) return OfferExtrinsics(event);
  const auto chunk = DecodeChunk(event.data);
  if (!chunk) return Handled::kRefused;
  Pass(assembler_.Add(*chunk));
  return Handled::kAccepted;
}

Handled SweepInput::OfferExtrinsics(const Event& event) {
  if (gate_.known()) return Handled::kIgnored;  // repeated for late joiners
  const std::optional<Pose3> T_body_lidar = DecodeExtrinsics(event.data);
  if (!T_body_lidar) return Handled::kRefused;
  gate_.Settle(*T_body_lidar);
  return Handled::kAccepted;
}

void SweepInput::Pass(const std::vector<Sweep>& sweeps) {
  const int64_t missing_chunks = assembler_.missing() - std::exchange(missing_counted_, assembler_.missing());
  int64_t skipped_sweeps = 0;
  for (const Sweep& sweep : sweeps) skipped_sweeps += skipped_.Missing(sweep.utime);
  health_.CountMissing(channel_, std::max(missing_chunks, skipped_sweeps));  // what both tell of is the same
  for (const Sweep& sweep : sweeps) {
    health_.NoteStamp(sweep.utime);
    gate_.Pass(sweep);
  }
}

void SweepInput::Flush() {
  Pass(assembler_.Finish());
  gate_.Flush();
}

}  // namespace lcmslam
