#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lcmslam {

// One laser of a spinning head.
struct Laser {
  double elevation_rad = 0.0;
  double azimuth_rad = 0.0;    // in the head, counter-clockwise
  double height_m = 0.0;       // of its beam on the axis of the head, over the lidar's origin
  double fire_delay_us = 0.0;  // after the start of the firing cycle
  int16_t ring = 0;            // 0 lowest
};

// A head of lasers that turns clockwise (seen from above) at constant speed and fires them in a fixed cycle. All beams
// leave from the axis of the head.
struct MultiLineModel {
  std::vector<Laser> lasers = {};  // in firing order
  double firing_cycle_us = 0.0;
  double turn_s = 0.1;  // so also between sweeps; a turn need not hold a whole number of cycles
  double min_range_m = 0.0;
  double max_range_m = 0.0;  // on a surface of full reflectivity met at a right angle

  std::string Validate() const;  // "" or "field: reason"
};

MultiLineModel VelodyneVlp16();   // 16 lasers, 2 degrees apart, about 28,900 shots a turn
MultiLineModel VelodyneHdl32e();  // 32 lasers, 1.33 degrees apart, -30.67..10.67, about 69,400 shots a turn
MultiLineModel VelodyneHdl64e();  // 64 lasers, -24.33..2 degrees, about 133,000 shots a turn
MultiLineModel OusterOs1_64();    // 64 lasers, -16.6..16.6 degrees, 1024 columns, 65,536 shots a turn

// "vlp16", "hdl32e", "hdl64e" or "os1-64"; none for other names.
[[nodiscard]] std::optional<MultiLineModel> NamedMultiLineModel(std::string_view name);

}  // namespace lcmslam
