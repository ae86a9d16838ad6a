#include "lidar/multi_line_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

// Rings are numbered by elevation, lowest first.
void NumberRings(std::vector<Laser>& lasers) {
  for (Laser& laser : lasers) {
    laser.ring = static_cast<int16_t>(
        std::ranges::count_if(lasers, [&](const Laser& l) { return l.elevation_rad < laser.elevation_rad; }));
  }
}

// Two interleaved halves, one laser after the other: lowest, lowest of the upper half, second lowest, ...
std::vector<Laser> Interleaved(int count, double lowest_deg, double step_deg, double interval_us) {
  std::vector<Laser> lasers;
  for (int i = 0; i < count; ++i) {
    const int ring = i / 2 + (i % 2) * count / 2;
    lasers.push_back({.elevation_rad = DegToRad(lowest_deg + ring * step_deg), .fire_delay_us = i * interval_us});
  }
  NumberRings(lasers);
  return lasers;
}

}  // namespace

std::string MultiLineModel::Validate() const {
  if (lasers.empty() || lasers.size() > 1000) return "lasers: must be 1..1000";
  for (size_t i = 0; i < lasers.size(); ++i) {
    if (!std::isfinite(lasers[i].elevation_rad + lasers[i].azimuth_rad + lasers[i].height_m))
      return "lasers: must be finite";
    const double previous_us = i > 0 ? lasers[i - 1].fire_delay_us : 0.0;
    if (!(lasers[i].fire_delay_us >= previous_us)) return "lasers: must be in firing order";
  }
  if (!(firing_cycle_us > lasers.back().fire_delay_us)) return "firing_cycle_us: must exceed the last fire_delay_us";
  if (!(firing_cycle_us >= 1.0)) return "firing_cycle_us: must be at least 1";
  if (!(turn_s >= 1e-3 && turn_s <= 10.0)) return "turn_s: must be in 0.001..10";
  if (!(1e6 * turn_s >= firing_cycle_us)) return "turn_s: must hold a firing cycle";
  if (!(min_range_m >= 0.0)) return "min_range_m: must not be negative";
  if (!(max_range_m > min_range_m) || !std::isfinite(max_range_m)) return "max_range_m: must exceed min_range_m";
  return "";
}

// Velodyne VLP-16 User Manual, 63-9243 rev. D, chapter 9: angles, vertical corrections, firing times.
MultiLineModel VelodyneVlp16() {
  constexpr std::array<double, 16> kHeight_mm = {11.2, 9.7,  8.1,  6.6,  5.1,  3.7,  2.2,  0.7,
                                                 -0.7, -2.2, -3.7, -5.1, -6.6, -8.1, -9.7, -11.2};  // by ring
  MultiLineModel model{.lasers = Interleaved(16, -15.0, 2.0, 2.304),
                       .firing_cycle_us = 55.296,
                       .min_range_m = 0.4,
                       .max_range_m = 100.0};
  for (Laser& laser : model.lasers) laser.height_m = 1e-3 * kHeight_mm[static_cast<size_t>(laser.ring)];
  return model;
}

// Velodyne HDL-32E User Manual, 63-9113 rev. M, appendix A.
MultiLineModel VelodyneHdl32e() {
  return {.lasers = Interleaved(32, -92.0 / 3.0, 4.0 / 3.0, 1.152),
          .firing_cycle_us = 46.08,
          .min_range_m = 0.4,
          .max_range_m = 100.0};
}

// Velodyne HDL-64E S2: 32 upper lasers 1/3 degree apart from 2 degrees down, 32 lower ones 1/2 degree apart, fired in
// pairs of one upper and one lower; the pairs are taken to be evenly spread over the 48 us cycle.
MultiLineModel VelodyneHdl64e() {
  MultiLineModel model{.firing_cycle_us = 48.0, .min_range_m = 0.9, .max_range_m = 120.0};
  for (int i = 0; i < 32; ++i) {
    model.lasers.push_back({.elevation_rad = DegToRad(2.0 - i / 3.0), .fire_delay_us = i * 1.5});
    model.lasers.push_back({.elevation_rad = DegToRad(-53.0 / 6.0 - i / 2.0), .fire_delay_us = i * 1.5});
  }
  NumberRings(model.lasers);
  return model;
}

// Ouster OS1-64, first generation, 1024x10: one column fires at once, neighbouring beams staggered in azimuth.
MultiLineModel OusterOs1_64() {
  constexpr std::array<double, 4> kStagger_deg = {3.164, 1.055, -1.055, -3.164};
  MultiLineModel model{.firing_cycle_us = 1e5 / 1024.0, .min_range_m = 0.3, .max_range_m = 120.0};
  for (int i = 0; i < 64; ++i) {
    model.lasers.push_back({.elevation_rad = DegToRad(16.6 - i * 33.2 / 63.0),
                            .azimuth_rad = DegToRad(kStagger_deg[static_cast<size_t>(i % 4)])});
  }
  NumberRings(model.lasers);
  return model;
}

std::optional<MultiLineModel> NamedMultiLineModel(std::string_view name) {
  if (name == "vlp16") return VelodyneVlp16();
  if (name == "hdl32e") return VelodyneHdl32e();
  if (name == "hdl64e") return VelodyneHdl64e();
  if (name == "os1-64") return OusterOs1_64();
  return std::nullopt;
}

}  // namespace lcmslam
