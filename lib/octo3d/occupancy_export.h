#pragma once

#include <iosfwd>
#include <string>

#include "octo3d/surfel_map.h"

namespace lcmslam::octo3d {

struct OccupancyExportOptions {
  bool free_space = true;  // cells on the way from a viewpoint to the leaves it saw
  double max_ray_m = 30.0;
  std::string Validate() const;  // "" or "field: reason"
};

// The map as OctoMap's occupancy octree (cells of leaf_m): every leaf occupied; free what lies between a leaf and the
// place it was last seen from, unless occupied. One ray per leaf: for the end of a run, not for every sweep.
void WriteOt(const SurfelMap& map, const OccupancyExportOptions& options, std::ostream& out);  // .ot: log-odds
void WriteBt(const SurfelMap& map, const OccupancyExportOptions& options, std::ostream& out);  // .bt: occupied or free

}  // namespace lcmslam::octo3d
