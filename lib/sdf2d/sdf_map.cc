#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {
namespace {

uint64_t Pack(int32_t tile_x, int32_t tile_y) {
  return (static_cast<uint64_t>(static_cast<uint32_t>(tile_x)) << 32) | static_cast<uint32_t>(tile_y);
}

}  // namespace

const SdfTile* SdfMap::Find(int32_t tile_x, int32_t tile_y) const {
  const auto found = by_index_.find(Pack(tile_x, tile_y));
  return found == by_index_.end() ? nullptr : &tiles_[found->second];
}

SdfTile* SdfMap::Find(int32_t tile_x, int32_t tile_y) {
  const auto found = by_index_.find(Pack(tile_x, tile_y));
  return found == by_index_.end() ? nullptr : &tiles_[found->second];
}

SdfTile& SdfMap::Touch(int32_t tile_x, int32_t tile_y) {
  const auto [found, created] = by_index_.try_emplace(Pack(tile_x, tile_y), static_cast<uint32_t>(tiles_.size()));
  if (created) tiles_.emplace_back(tile_x, tile_y);
  return tiles_[found->second];
}

}  // namespace lcmslam::sdf2d
