#pragma once

#include <span>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "sdf2d/noise_model.h"
#include "sdf2d/options.h"
#include "sdf2d/scan_field.h"
#include "sdf2d/sdf_map.h"

namespace lcmslam::sdf2d {

// Information-weighted mean of what the map holds and what the scan says; a vertex that contradicts clearly loses its
// old evidence first, so that a changed world is learnt.
void Fuse(const ScanField& field, const FusionOptions& options, SdfMap* map);

// A coarser map of the same surfaces, as Fuse would have made it from the fine map's own zero crossings.
[[nodiscard]] SdfMap Coarsen(const SdfMap& fine, double coarse_cell_m, const FusionOptions& options);

// Walks every carve_every-th beam (starting at `first`) from the lidar towards its end and takes evidence from
// vertices that claim to lie behind a surface; the others are marked as seen through. Stops short of the surface it
// hit. p_body: end points, deskewed.
void Carve(std::span<const Eigen::Vector2d> p_body, const Eigen::Vector2d& origin_body, const Pose2& T_map_body,
           const NoiseModel& noise, int first, const FusionOptions& options, SdfMap* map);

}  // namespace lcmslam::sdf2d
