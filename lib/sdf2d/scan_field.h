#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/pose2.h"
#include "sdf2d/options.h"
#include "sdf2d/surface.h"

namespace lcmslam::sdf2d {

// What one scan says about one map vertex.
struct VertexMeasurement {
  int32_t x = 0;  // vertex index
  int32_t y = 0;
  float distance_m = 0.0F;    // signed, > 0 on the lidar's side
  float information = 0.0F;   // 1/m^2
  float remoteness_m = 0.0F;  // to the piece of surface that said so
  int32_t sheet = 0;          // that it belongs to
};

// The signed distance field of one scan, near its surfaces only. Where two surfaces reach a vertex the nearer one
// speaks, so that a wall does not write into its neighbour at a corner (the thesis' level rule, for one scan).
class ScanField {
 public:
  // Replaces the field by that of `lines` seen from T_map_body.
  void Rasterize(std::span<const SurfaceLine> lines, const Pose2& T_map_body, double cell_m,
                 const FusionOptions& options);

  // In the order in which the vertices were first reached.
  const std::vector<VertexMeasurement>& measurements() const { return measurements_; }

 private:
  void AddLine(const SurfaceLine& line, const Pose2& T_map_body, double cell_m, const FusionOptions& options);
  void Offer(const VertexMeasurement& candidate);
  void Grow();
  size_t SlotOf(int32_t x, int32_t y, int32_t sheet) const;

  std::vector<VertexMeasurement> measurements_;
  // Open addressing: position in measurements_ + 1; valid where its stamp is the present one.
  struct Slot {
    uint32_t stamp = 0;
    uint32_t position = 0;
  };
  std::vector<Slot> slots_ = std::vector<Slot>(1 << 13);
  uint32_t stamp_ = 0;
};

}  // namespace lcmslam::sdf2d
