#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "lidar/deskew.h"
#include "sdf2d/options.h"

namespace lcmslam::sdf2d {

// The standard deviation of a range, learnt from the scans: on a straight wall the inverse ranges of three beams obey
//   sin(c-b) / r_a - sin(c-a) / r_b + sin(b-a) / r_c = 0     (a, b, c: beam angles),
// so what this triple gives instead of zero, divided by its derivatives, samples the noise. Most triples lie on one
// surface; the others are cut off by trimming.
class NoiseModel {
 public:
  explicit NoiseModel(const NoiseOptions& options);

  // m, of a beam of that range.
  double Sigma(double range_m) const {
    const double variance = constant_m2_ + proportional2_ * range_m * range_m;
    return std::sqrt(std::max(variance, options_.floor_m * options_.floor_m));
  }

  // Learns from one scan (nothing where estimation is off). `origin_body`: the lidar's.
  void Observe(std::span<const ScanPoint> points, const Eigen::Vector2d& origin_body);

 private:
  // Ranges within a factor of sqrt(2); histogram of log2 |residual|.
  struct RangeBin {
    static constexpr int kLevels = 96;
    std::array<float, kLevels> count{};
    double TrimmedSigma(double* total) const;
  };
  static constexpr int kBins = 20;

  void Fit();

  NoiseOptions options_;
  double constant_m2_;
  double proportional2_;
  std::array<RangeBin, kBins> bins_;
};

}  // namespace lcmslam::sdf2d
