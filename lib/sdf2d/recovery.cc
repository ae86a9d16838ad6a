#include "sdf2d/recovery.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sdf2d/sdf_reader.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;

constexpr int kSearchPoints = 80;    // of the scan
constexpr size_t kCandidates = 12;   // refined on the maps
constexpr double kStep_cells = 1.0;  // of the coarse map
constexpr double kYawStep_rad = 0.1;
constexpr double kCoarseSigma_cells = 0.25;  // error of the coarse map

struct Candidate {
  double score = 0.0;
  Pose2 T_map_body;
};

double Score(SdfReader& reader, std::span<const Vector2d> p_rotated, const Vector2d& translation, double width_m) {
  double score = 0.0;
  for (const Vector2d& p : p_rotated) {
    const Vector2d p_map = p + translation;
    const double distance =
        std::fmin(std::abs(reader.At(0, p_map).distance_m), std::abs(reader.At(1, p_map).distance_m));
    if (distance < width_m) score += 1.0 - distance / width_m;
  }
  return score;
}

// The best of the window, at least a search step apart.
std::vector<Candidate> BestOfWindow(const SdfMap& coarse_map, std::span<const Vector2d> p_body, const Pose2& center,
                                    double search_m, double search_rad) {
  const double step_m = kStep_cells * coarse_map.cell_m();
  const int n = static_cast<int>(std::ceil(search_m / step_m));
  const int n_yaw = static_cast<int>(std::ceil(search_rad / kYawStep_rad));
  SdfReader reader(coarse_map);
  std::vector<Candidate> best;
  std::vector<Vector2d> p_rotated(p_body.size());
  for (int k = -n_yaw; k <= n_yaw; ++k) {
    const Pose2 turn(0.0, 0.0, center.yaw() + k * kYawStep_rad);
    for (size_t i = 0; i < p_body.size(); ++i) p_rotated[i] = turn * p_body[i];
    for (int iy = -n; iy <= n; ++iy) {
      for (int ix = -n; ix <= n; ++ix) {
        const Vector2d translation = center.translation() + step_m * Vector2d(ix, iy);
        const double score = Score(reader, p_rotated, translation, coarse_map.cell_m());
        if (best.size() == kCandidates && score <= best.back().score) continue;
        const Candidate candidate{score, Pose2(translation, turn.yaw())};
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
  for (size_t i = 0; i < p_body.size(); i += stride) sparse.push_back(p_body[i]);

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
