#include "baselines/cloud3d_icp.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>

namespace lcmslam::cloud3d {
namespace {

constexpr double kMinPivotRatio = 1e-9;
constexpr size_t kMinMatches = 10;  // a pose has six unknowns

Pose3 Stepped(const Pose3& T_map_body, const Vector6& step) {
  const Eigen::Vector3d turn = step.tail<3>();
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return {T_map_body.translation + step.head<3>(), (rotation * T_map_body.rotation).normalized()};
}

// Says when the last steps were small on average.
class StepChecker {
 public:
  explicit StepChecker(const IcpOptions& options) : options_(options) {}

  bool IsDoneAfter(const Vector6& step) {
    steps_.push_back({step.head<3>().norm(), step.tail<3>().norm()});
    if (std::ssize(steps_) < options_.smoothed_steps) return false;
    if (std::ssize(steps_) > options_.smoothed_steps) steps_.pop_front();
    const Eigen::Vector2d sum = std::accumulate(steps_.begin(), steps_.end(), Eigen::Vector2d(Eigen::Vector2d::Zero()));
    return sum.x() < options_.min_step_m * options_.smoothed_steps &&
           sum.y() < options_.min_step_rad * options_.smoothed_steps;
  }

 private:
  const IcpOptions& options_;
  std::deque<Eigen::Vector2d> steps_;  // length, angle
};

}  // namespace

std::string IcpOptions::Validate() const {
  if (neighbours < 1 || neighbours > 100) return "neighbours: must be in 1..100";
  if (!(epsilon >= 0.0 && epsilon <= 100.0)) return "epsilon: must be in [0, 100]";
  if (!(max_distance_m > 0.0)) return "max_distance_m: must be positive";
  if (!(trim_ratio > 0.0 && trim_ratio <= 1.0)) return "trim_ratio: must be in (0, 1]";
  if (!(max_normal_angle_rad >= 0.0)) return "max_normal_angle_rad: must not be negative";
  if (max_iterations < 1 || max_iterations > 1000) return "max_iterations: must be in 1..1000";
  if (!(min_step_m > 0.0)) return "min_step_m: must be positive";
  if (!(min_step_rad > 0.0)) return "min_step_rad: must be positive";
  if (smoothed_steps < 1 || smoothed_steps > 100) return "smoothed_steps: must be in 1..100";
  if (!(min_overlap >= 0.0 && min_overlap <= 1.0)) return "min_overlap: must be in [0, 1]";
  return "";
}

std::vector<Match> FindMatches(const Map& map, const Cloud& reading_map, const IcpOptions& options) {
  std::vector<Match> matches;
  matches.reserve(reading_map.size() * options.neighbours);
  std::vector<Neighbour> found(options.neighbours);
  const float max_distance_m = static_cast<float>(options.max_distance_m);
  const float epsilon = static_cast<float>(options.epsilon);
  for (uint32_t i = 0; i < reading_map.size(); ++i) {
    const int count = map.tree().Nearest(reading_map.points[i], max_distance_m, epsilon, found);
    for (const Neighbour& neighbour : std::span(found).first(count)) {
      matches.push_back({i, neighbour.index, neighbour.distance_m2});
    }
  }
  return matches;
}

std::vector<Match> KeepInliers(const Map& map, const Cloud& reading_map, std::vector<Match> matches,
                               const IcpOptions& options) {
  if (matches.empty()) return matches;
  std::vector<float> distances_m2(matches.size());
  std::ranges::transform(matches, distances_m2.begin(), &Match::distance_m2);
  const size_t rank =
      std::min(static_cast<size_t>(options.trim_ratio * static_cast<double>(matches.size())), matches.size() - 1);
  std::nth_element(distances_m2.begin(), distances_m2.begin() + rank, distances_m2.end());
  std::erase_if(matches, [limit_m2 = distances_m2[rank]](const Match& match) { return match.distance_m2 > limit_m2; });
  if (options.max_normal_angle_rad > 0.0) {
    const float min_cosine = static_cast<float>(std::cos(std::min(options.max_normal_angle_rad, std::numbers::pi)));
    std::erase_if(matches, [&](const Match& match) {
      return reading_map.normals[match.reading].dot(map.normals()[match.map]) < min_cosine;
    });
  }
  return matches;
}

NormalEquations Linearize(const Map& map, const Cloud& reading_map, std::span<const Match> matches,
                          const Eigen::Vector3d& centre) {
  NormalEquations sums;
  for (const Match& match : matches) {
    const Eigen::Vector3d p = reading_map.points[match.reading].cast<double>();
    const Eigen::Vector3d q = map.points()[match.map].cast<double>();
    const Eigen::Vector3d n = map.normals()[match.map].cast<double>();
    Vector6 J;
    J << n, (p - centre).cross(n);
    const double r = n.dot(p - q);
    sums.H.selfadjointView<Eigen::Lower>().rankUpdate(J);
    sums.b -= r * J;
    sums.r2 += r * r;
  }
  sums.H = sums.H.selfadjointView<Eigen::Lower>();
  return sums;
}

IcpResult Icp(const Map& map, const Cloud& reading_body, const Pose3& T_map_body_guess, const IcpOptions& options) {
  IcpResult result{.T_map_body = T_map_body_guess};
  StepChecker checker(options);
  for (bool done = false; !done && result.iterations < options.max_iterations;) {
    const Cloud reading_map = Transformed(result.T_map_body, reading_body);
    const std::vector<Match> matches = KeepInliers(map, reading_map, FindMatches(map, reading_map, options), options);
    result.inlier_ratio =
        static_cast<double>(matches.size()) / std::max<double>(1.0, reading_body.size() * options.neighbours);
    const NormalEquations sums = Linearize(map, reading_map, matches, result.T_map_body.translation);
    const Eigen::LDLT<Matrix6> factor(sums.H);
    const Vector6 pivots = factor.vectorD();
    if (matches.size() < kMinMatches || !(pivots.minCoeff() > kMinPivotRatio * pivots.maxCoeff())) {
      result.T_map_body = T_map_body_guess;
      return result;
    }
    const Vector6 step = factor.solve(sums.b);
    result.T_map_body = Stepped(result.T_map_body, step);
    result.residual_rms_m = std::sqrt(sums.r2 / static_cast<double>(matches.size()));
    result.covariance = factor.solve(Matrix6::Identity()) * (sums.r2 / (static_cast<double>(matches.size()) - 6.0));
    ++result.iterations;
    done = checker.IsDoneAfter(step);
  }
  result.solved = result.inlier_ratio >= options.min_overlap;
  if (!result.solved) result.T_map_body = T_map_body_guess;
  return result;
}

}  // namespace lcmslam::cloud3d
