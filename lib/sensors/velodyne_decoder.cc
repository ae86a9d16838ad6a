#include "sensors/velodyne_decoder.h"

#include "sensors/bad_input.h"
#include "sensors/velodyne_packet.h"

namespace lcmslam {

std::vector<Sweep> VelodyneDecoder::Add(std::span<const uint8_t> payload, std::optional<int64_t> received_utime) {
  try {
    const VelodynePacket packet = DecodeVelodynePacket(payload);
    ++packets_;
    return assembler_.Add(packet, received_utime);
  } catch (const BadInput&) {
    ++refused_;
    return {};
  }
}

}  // namespace lcmslam
