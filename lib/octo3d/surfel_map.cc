#include "octo3d/surfel_map.h"

#include <algorithm>

#include "octo3d/surfel_map_impl.h"

namespace lcmslam::octo3d {

SurfelMap::SurfelMap(const MapOptions& options) : impl_(std::make_unique<Impl>(options)) {}
SurfelMap::~SurfelMap() = default;
SurfelMap::SurfelMap(SurfelMap&&) noexcept = default;
SurfelMap& SurfelMap::operator=(SurfelMap&&) noexcept = default;

void SurfelMap::Insert(std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& viewpoint) {
  impl_->Insert(points, viewpoint);
}
void SurfelMap::Find(std::span<const Eigen::Vector3d> points, std::span<PlaneMatch> planes) const {
  impl_->Find(points, planes);
}
PlaneMatch SurfelMap::Find(const Eigen::Vector3d& p) const {
  PlaneMatch plane;
  impl_->Find({&p, 1}, {&plane, 1});
  return plane;
}
PlaneMatch SurfelMap::FindNear(const Eigen::Vector3d& p, int level) const {
  return impl_->FindNear(p, std::clamp(level, 0, impl_->options.levels - 1));
}
std::vector<Surfel> SurfelMap::ChangedSince(uint32_t revision) const { return impl_->ChangedSince(revision); }
std::vector<Surfel> SurfelMap::InTurn(size_t& turn, size_t count) const { return impl_->InTurn(turn, count); }
std::vector<LeafRecord> SurfelMap::Leaves() const { return impl_->Leaves(); }
void SurfelMap::Restore(std::span<const LeafRecord> leaves, std::span<const Eigen::Vector3f> viewpoints) {
  Clear();
  impl_->Restore(leaves, viewpoints);
}
void SurfelMap::Clear() {
  const uint32_t revision = impl_->revision;
  impl_ = std::make_unique<Impl>(impl_->options);
  impl_->revision = revision;  // keeps growing, so that ChangedSince() never misses a rebuilt map
}
uint32_t SurfelMap::revision() const { return impl_->revision; }
size_t SurfelMap::num_cells() const { return impl_->num_cells; }
size_t SurfelMap::num_leaves() const { return impl_->num_leaves; }
const std::vector<Eigen::Vector3f>& SurfelMap::viewpoints() const { return impl_->viewpoints; }
const MapOptions& SurfelMap::options() const { return impl_->options; }

}  // namespace lcmslam::octo3d
