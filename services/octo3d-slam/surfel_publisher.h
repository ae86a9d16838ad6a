#pragma once

#include <cstdint>
#include <string>

#include "bus/service.h"
#include "octo3d/surfel_map.h"

namespace lcmslam {

// Sends a surfel map in surfel_chunk_t of at most 60 kB: what changed since the last time, and a part of all the rest
// in turn, for late joiners.
class SurfelPublisher {
 public:
  // "": sends nothing.
  explicit SurfelPublisher(std::string channel) : channel_(std::move(channel)) {}

  void Publish(const octo3d::SurfelMap& map, int64_t utime, ServiceContext& context);
  // The map is another one.
  void Restart();

 private:
  std::string channel_;
  int32_t epoch_ = 0;
  uint32_t revision_ = 0;  // of the map when it was published last
  size_t turn_ = 0;
};

}  // namespace lcmslam
