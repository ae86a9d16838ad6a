#include "sdf2d/recovery.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sdf2d/sdf_reader.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

constexpr int kSearchPoints = 80;        // of the scan
constexpr double kSearchReach_m = 30.0;  // points farther out do not take part
constexpr size_t kCandidates = 12;       // refined on the maps
constexpr double kYawStep_rad = 0.1;
constexpr double kCoarseSigma_cells = 0.25;  // error of the coarse map

struct Candidate {
  float score = 0.0F;
  Pose2 T_map_body;
};

// How well a point fits the coarse map, 0 to 1, sampled over a square: a search asks for every cell many times.
class FitGrid {
 public:
  FitGrid(const SdfMap& coarse_map, const Vector2d& center, double half_side_m)
      : cell_m_(coarse_map.cell_m() / kCellsPerStep),
        side_(2 * static_cast<int>(std::ceil(half_side_m / cell_m_)) + 3),
        origin_(center - Vector2d::Constant(0.5 * (side_ - 1) * cell_m_)) {
    SdfReader reader(coarse_map);
    fit_.reserve(static_cast<size_t>(side_) * static_cast<size_t>(side_));
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) fit_.push_back(Fit(reader, origin_ + cell_m_ * Vector2d(x, y)));
    }
  }

  int IndexOf(const Vector2d& p_map) const {
    const Vector2d cell = (p_map - origin_) / cell_m_;
    return static_cast<int>(std::lround(cell.y())) * side_ + static_cast<int>(std::lround(cell.x()));
  }
  // What a step of the search adds to an index.
  int Shift(int steps_x, int steps_y) const { return kCellsPerStep * (steps_y * side_ + steps_x); }
  float operator[](int index) const { return fit_[static_cast<size_t>(index)]; }

 private:
  static constexpr int kCellsPerStep = 2;  // a step is a cell of the coarse map

  float Fit(SdfReader& reader, const Vector2d& p_map) const {
    const double width_m = kCellsPerStep * cell_m_;
    const double distance_m =
        std::fmin(std::abs(reader.At(0, p_map).distance_m), std::abs(reader.At(1, p_map).distance_m));
    return distance_m < width_m ? static_cast<float>(1.0 - distance_m / width_m) : 0.0F;
  }

  double cell_m_;
  int side_;
  Vector2d origin_;
  std::vector<float> fit_;
};

// The best of the window, at least a search step apart.
std::vector<Candidate> BestOfWindow(const SdfMap& coarse_map, std::span<const Vector2d> p_body, const Pose2& center,
                                    double search_m, double search_rad) {
  const double step_m = coarse_map.cell_m();
  const int n = static_cast<int>(std::ceil(search_m / step_m));
  const int n_yaw = static_cast<int>(std::ceil(search_rad / kYawStep_rad));
  double reach_m = 0.0;
  for (const Vector2d& p : p_body) reach_m = std::max(reach_m, p.norm());
  const FitGrid fit(coarse_map, center.translation(), n * step_m + reach_m);

  std::vector<Candidate> best;
  std::vector<int> cells(p_body.size());
  for (int k = -n_yaw; k <= n_yaw; ++k) {
    const Pose2 turned(center.x(), center.y(), center.yaw() + k * kYawStep_rad);
    for (size_t i = 0; i < p_body.size(); ++i) cells[i] = fit.IndexOf(turned * p_body[i]);
    for (int iy = -n; iy <= n; ++iy) {
      for (int ix = -n; ix <= n; ++ix) {
        const int shift = fit.Shift(ix, iy);
        float score = 0.0F;
        for (const int cell : cells) score += fit[cell + shift];
        if (best.size() == kCandidates && score <= best.back().score) continue;
        const Vector2d translation = center.translation() + step_m * Vector2d(ix, iy);
        const Candidate candidate{score, Pose2(translation, turned.yaw())};
        best.insert(std::upper_bound(best.begin(), best.end(), candidate,
                                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; }),
                    candidate);
        if (best.size() > kCandidates) best.pop_back();
      }
    }
  }
  return best;
}

}  // namespace

AlignResult AlignCoarseToFine(const SdfMap& map, const SdfMap& coarse_map, std::span<const ScanPoint> points,
                              const Vector2d& origin_body, const NoiseModel& noise, const MotionState& prediction,
                              const RegistrationOptions& options) {
  RegistrationOptions coarse_options = options;
  coarse_options.map_sigma_m = kCoarseSigma_cells * coarse_map.cell_m();
  MotionState start = prediction;
  start.covariance.diagonal().array() += 0.04;  // what the coarse level is for: the prediction is off
  const AlignResult coarse = Align(coarse_map, points, origin_body, noise, start, coarse_options);
  start.T_map_body = coarse.state.T_map_body;
  start.twist_body = coarse.state.twist_body;
  return Align(map, points, origin_body, noise, start, options);
}

AlignResult SearchAround(const SdfMap& map, const SdfMap& coarse_map, std::span<const ScanPoint> points,
                         const Vector2d& origin_body, const NoiseModel& noise, const MotionState& prediction,
                         double search_m, double search_rad, const RegistrationOptions& options) {
  std::vector<Vector2d> p_body;
  Deskew(points, prediction.twist_body, &p_body);
  std::vector<Vector2d> sparse;
  const size_t stride = std::max<size_t>(1, p_body.size() / kSearchPoints);
  for (size_t i = 0; i < p_body.size(); i += stride) {
    if (p_body[i].norm() < kSearchReach_m) sparse.push_back(p_body[i]);
  }

  AlignResult best;
  best.points = static_cast<int>(points.size());
  best.state = prediction;
  for (const Candidate& candidate : BestOfWindow(coarse_map, sparse, prediction.T_map_body, search_m, search_rad)) {
    MotionState start = prediction;
    start.T_map_body = candidate.T_map_body;
    const AlignResult refined = AlignCoarseToFine(map, coarse_map, points, origin_body, noise, start, options);
    if (refined.inliers > best.inliers) best = refined;
  }
  return best;
}

}  // namespace lcmslam::sdf2d
