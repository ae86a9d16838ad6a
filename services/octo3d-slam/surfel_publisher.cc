#include "octo3d-slam/surfel_publisher.h"

#include <algorithm>
#include <span>
#include <vector>

#include <lcmslam/surfel_chunk_t.hpp>

namespace lcmslam {
namespace {

constexpr size_t kSurfelsPerChunk = 1600;  // of 36 bytes each
constexpr size_t kSurfelsInTurn = 400;

surfel_chunk_t ChunkMessage(int64_t utime, int32_t epoch, std::span<const octo3d::Surfel> surfels) {
  surfel_chunk_t message{};
  message.utime = utime;
  message.num_surfels = static_cast<int32_t>(surfels.size());
  message.epoch = epoch;
  for (const octo3d::Surfel& surfel : surfels) {
    message.x.push_back(surfel.mean.x());
    message.y.push_back(surfel.mean.y());
    message.z.push_back(surfel.mean.z());
    message.normal_x.push_back(surfel.normal.x());
    message.normal_y.push_back(surfel.normal.y());
    message.normal_z.push_back(surfel.normal.z());
    message.cell_size.push_back(surfel.cell_m);
    message.spread.push_back(surfel.thickness_m);
    message.count.push_back(static_cast<int32_t>(std::min<uint32_t>(surfel.count, INT32_MAX)));
  }
  return message;
}

}  // namespace

void SurfelPublisher::Publish(const octo3d::SurfelMap& map, int64_t utime, ServiceContext& context) {
  if (channel_.empty()) return;
  std::vector<octo3d::Surfel> surfels = map.InTurn(turn_, kSurfelsInTurn);
  std::ranges::copy(map.ChangedSince(revision_), std::back_inserter(surfels));
  revision_ = map.revision();
  for (std::span<const octo3d::Surfel> rest = surfels; !rest.empty();) {
    const size_t size = std::min(rest.size(), kSurfelsPerChunk);
    context.Publish(channel_, ChunkMessage(utime, epoch_, rest.first(size)));
    rest = rest.subspan(size);
  }
}

void SurfelPublisher::Restart() {
  ++epoch_;
  revision_ = 0;
  turn_ = 0;
}

}  // namespace lcmslam
