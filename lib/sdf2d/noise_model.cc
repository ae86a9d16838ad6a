#include "sdf2d/noise_model.h"

#include <algorithm>
#include <cmath>

namespace lcmslam::sdf2d {
namespace {

constexpr int kStride = 3;            // beams between the three; neighbours share quantization and spot overlap
constexpr size_t kEvery = 2;          // triples looked at
constexpr double kMaxRatio = 1.3;     // of ranges within a triple; beyond lies an edge
constexpr double kForget = 0.97;      // per scan
constexpr double kMinCount = 20.0;    // triples a range bin needs to be believed
constexpr double kSmallest_m = 1e-4;  // of the histogram, 8 levels per factor of 2
constexpr double kLevelsPerOctave = 8.0;
constexpr double kQuantile = 0.5;
constexpr double kQuantileSigmas = 0.6745;  // of |normal| at kQuantile

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

int RangeBinOf(double range_m) { return static_cast<int>(std::floor(2.0 * std::log2(range_m))) + 7; }  // 0: 0.09 m
double BinRange_m(int bin) { return std::exp2(0.5 * (bin - 7 + 0.5)); }

}  // namespace

NoiseModel::NoiseModel(const NoiseOptions& options)
    : options_(options),
      constant_m2_(options.constant_m * options.constant_m),
      proportional2_(options.proportional * options.proportional) {}

void NoiseModel::Observe(std::span<const ScanPoint> points, const Eigen::Vector2d& origin_body) {
  if (!options_.estimate) return;
  for (RangeBin& bin : bins_) {
    for (float& count : bin.count) count *= static_cast<float>(kForget);
  }
  for (size_t i = 0; i + 2 * kStride < points.size(); i += kEvery) {
    const Eigen::Vector2d a = points[i].p_body - origin_body;
    const Eigen::Vector2d b = points[i + kStride].p_body - origin_body;
    const Eigen::Vector2d c = points[i + 2 * kStride].p_body - origin_body;
    const double ra = points[i].range_m, rb = points[i + kStride].range_m, rc = points[i + 2 * kStride].range_m;
    if (std::max({ra, rb, rc}) > kMaxRatio * std::min({ra, rb, rc})) continue;
    // Twice the triangle's area a x b + b x c + c x a is the identity above times the three ranges.
    const double ab = Cross(a, b), bc = Cross(b, c), ac = Cross(a, c);
    const double residual = ab + bc - ac;
    const double ga = (ab - ac) / ra, gb = (ab + bc) / rb, gc = (bc - ac) / rc;  // by each range
    const double gain = std::sqrt(ga * ga + gb * gb + gc * gc);
    if (!(gain > 0.0)) continue;
    const int bin = std::clamp(RangeBinOf(rb), 0, kBins - 1);
    const double sample_m = std::max(std::abs(residual) / gain, kSmallest_m);
    const int level = static_cast<int>(kLevelsPerOctave * std::log2(sample_m / kSmallest_m));
    bins_[bin].count[std::min(level, RangeBin::kLevels - 1)] += 1.0F;
  }
  Fit();
}

double NoiseModel::RangeBin::TrimmedSigma(double* total) const {
  *total = 0.0;
  for (const float c : count) *total += c;
  double below = 0.0;
  for (int level = 0; level < kLevels; ++level) {
    below += count[level];
    if (below < kQuantile * *total) continue;
    const double inside = count[level] > 0.0F ? (below - kQuantile * *total) / count[level] : 0.0;
    return kSmallest_m * std::exp2((level + 1.0 - inside) / kLevelsPerOctave) / kQuantileSigmas;
  }
  return 0.0;
}

// Weighted least squares of sigma^2 = constant^2 + proportional^2 r^2 over the range bins, both terms non-negative.
void NoiseModel::Fit() {
  double n = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;
  for (int bin = 0; bin < kBins; ++bin) {
    double total = 0.0;
    const double sigma = std::max(bins_[bin].TrimmedSigma(&total), options_.floor_m);
    if (total < kMinCount) continue;
    const double r2 = BinRange_m(bin) * BinRange_m(bin);
    const double variance = sigma * sigma;
    const double w = total / (variance * variance);
    n += w, x += w * r2, xx += w * r2 * r2, y += w * variance, xy += w * r2 * variance;
  }
  if (!(n > 0.0)) return;
  const double determinant = n * xx - x * x;
  if (determinant > 1e-9 * n * xx) {
    constant_m2_ = (xx * y - x * xy) / determinant;
    proportional2_ = (n * xy - x * y) / determinant;
  } else {
    constant_m2_ = y / n;
    proportional2_ = 0.0;
  }
  if (constant_m2_ < 0.0) {
    constant_m2_ = 0.0;
    proportional2_ = xy / xx;
  } else if (proportional2_ < 0.0) {
    constant_m2_ = y / n;
    proportional2_ = 0.0;
  }
}

}  // namespace lcmslam::sdf2d
