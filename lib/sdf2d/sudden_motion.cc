#include "sdf2d/sudden_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf2d/recovery.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurnStep_rad = 0.1;
constexpr int kMaxRounds = 4;

Pose2 LastPose(const MotionState& prediction, double dt_s) {
  return prediction.T_map_body * Pose2::Exp(-dt_s * prediction.twist_body);
}

Vector3d MeanTwist(const Pose2& T_map_last, const Pose2& T_map_body, double dt_s) {
  return (T_map_last.inverse() * T_map_body).Log() / dt_s;
}

}  // namespace

double Skew_rad(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s,
                const Pose2& T_map_body) {
  if (dt_s == 0.0) return 0.0;
  double sweep_s = 0.0;
  for (const ScanPoint& point : points) sweep_s = std::max(sweep_s, -point.dt_s);
  const Vector3d twist = MeanTwist(LastPose(prediction, dt_s), T_map_body, dt_s);
  return std::abs(twist.z() - prediction.twist_body.z()) * sweep_s;
}

AlignResult AlignDeskewedAgain(const SdfMap& map, std::span<const ScanPoint> points, const Vector2d& origin_body,
                               const NoiseModel& noise, const MotionState& prediction, double dt_s,
                               const AlignResult& align, const RegistrationOptions& options) {
  const Pose2 T_map_last = LastPose(prediction, dt_s);
  AlignResult best = align;
  for (int i = 0; i < kMaxRounds; ++i) {
    MotionState start = prediction;
    start.T_map_body = best.state.T_map_body;
    start.twist_body = MeanTwist(T_map_last, start.T_map_body, dt_s);
    const AlignResult again = Align(map, points, origin_body, noise, start, options);
    if (again.inliers < best.inliers) break;
    best = again;
  }
  return best;
}

AlignResult AlignTurning(const SdfMap& map, const SdfMap& coarse_map, std::span<const ScanPoint> points,
                         const Vector2d& origin_body, const NoiseModel& noise, const MotionState& prediction,
                         double dt_s, double max_turn_rate, const RegistrationOptions& options) {
  const Pose2 T_map_last = LastPose(prediction, dt_s);
  AlignResult best;
  best.points = static_cast<int>(points.size());
  best.state = prediction;
  const int n = static_cast<int>(std::min(max_turn_rate * dt_s, std::numbers::pi) / kTurnStep_rad);
  for (int i = -n; i <= n; ++i) {
    MotionState start = prediction;
    start.twist_body.z() = i * kTurnStep_rad / dt_s;
    start.T_map_body = T_map_last * Pose2::Exp(dt_s * start.twist_body);
    const AlignResult turned = AlignCoarseToFine(map, coarse_map, points, origin_body, noise, start, options);
    if (turned.inliers > best.inliers) best = turned;
  }
  return AlignDeskewedAgain(map, points, origin_body, noise, prediction, dt_s, best, options);
}

}  // namespace lcmslam::sdf2d
