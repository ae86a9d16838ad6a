#include "sensors/velodyne_reader.h"

#include <utility>

namespace lcmslam {

std::optional<Sweep> VelodyneReader::Next() {
  while (ready_.empty()) {
    const std::optional<VelodynePayload> payload = payloads_.Next();
    if (!payload) return std::nullopt;
    for (Sweep& sweep : decoder_.Add(payload->bytes, payload->received_utime)) ready_.push_back(std::move(sweep));
  }
  Sweep sweep = std::move(ready_.front());
  ready_.pop_front();
  return sweep;
}

}  // namespace lcmslam
