#include "trajectory/alignment.h"

#include <array>
#include <cmath>

#include <Eigen/SVD>
#include <fmt/format.h>

namespace lcmslam {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"none", "first", "yaw", "se2", "se3"};

Eigen::JacobiSVD<Eigen::Matrix3d> Svd(const Eigen::Matrix3d& matrix) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

// Among Rot(axis, angle) * start, the rotation R that maximizes trace(R^T correlation). `strength` is how much that
// trace changes with the angle.
struct TurnResult {
  Eigen::Matrix3d rotation;
  double strength;
};
TurnResult TurnAbout(const Eigen::Vector3d& axis, const Eigen::Matrix3d& start, const Eigen::Matrix3d& correlation) {
  const Eigen::Matrix3d b = start * correlation.transpose();
  const double sine = axis.dot(Eigen::Vector3d(b(1, 2) - b(2, 1), b(2, 0) - b(0, 2), b(0, 1) - b(1, 0)));
  const double cosine = b.trace() - axis.dot(b * axis);
  return {Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix() * start, std::hypot(sine, cosine)};
}

Eigen::Matrix3d SolveYaw(const PairMoments& m, double min_spread_m, std::vector<Eigen::Vector3d>& unobservable_axes) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const TurnResult turn = TurnAbout(up, Eigen::Matrix3d::Identity(), m.positions());
  if (std::sqrt(turn.strength) >= min_spread_m) return turn.rotation;
  unobservable_axes = {up};
  return TurnAbout(up, Eigen::Matrix3d::Identity(), m.orientations()).rotation;
}

Eigen::Matrix3d SolveRotation(const PairMoments& m, double min_spread_m,
                              std::vector<Eigen::Vector3d>& unobservable_axes) {
  const auto svd = Svd(m.positions());
  const Eigen::Vector3d spread_m = svd.singularValues().cwiseSqrt();
  if (spread_m[1] >= min_spread_m) return NearestRotation(m.positions());
  if (spread_m[0] < min_spread_m) {
    unobservable_axes = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
    return NearestRotation(m.orientations());
  }
  const Eigen::Vector3d direction = svd.matrixU().col(0);
  unobservable_axes = {direction};
  return TurnAbout(direction, NearestRotation(m.positions()), m.orientations()).rotation;
}

}  // namespace

std::string_view Name(AlignmentKind kind) { return kNames[static_cast<size_t>(kind)]; }

std::optional<AlignmentKind> ParseAlignmentKind(std::string_view name) {
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<AlignmentKind>(i);
  }
  return std::nullopt;
}

std::string AlignmentOptions::Validate() const {
  return min_spread_m >= 0.0 ? "" : "min_spread_m: must not be negative";
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& correlation) {
  const auto svd = Svd(correlation);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Eigen::Vector3d(1.0, 1.0, handedness).asDiagonal() * svd.matrixV().transpose();
}

Alignment Align(const PairMoments& moments, const PosePair& first, AlignmentKind kind,
                const AlignmentOptions& options) {
  Alignment result{.status = AlignmentStatus::kOk, .kind = kind, .T_world_map = {}};
  if (kind == AlignmentKind::kNone) return result;
  if (kind == AlignmentKind::kFirst) {
    result.T_world_map = first.reference * first.estimate.inverse();
    return result;
  }
  const auto solve = kind == AlignmentKind::kSe3 ? SolveRotation : SolveYaw;
  const Eigen::Matrix3d rotation = solve(moments, options.min_spread_m, result.unobservable_axes);
  result.T_world_map.rotation = Eigen::Quaterniond(rotation).normalized();
  result.T_world_map.translation = moments.mean_reference() - result.T_world_map.rotation * moments.mean_estimate();
  if (kind == AlignmentKind::kSe2) result.T_world_map.translation.z() = 0.0;
  return result;
}

Alignment Align(std::span<const PosePair> pairs, AlignmentKind kind, const AlignmentOptions& options) {
  if (pairs.empty()) return {.status = AlignmentStatus::kNoPairs, .kind = kind, .T_world_map = {}};
  PairMoments moments;
  if (kind != AlignmentKind::kNone && kind != AlignmentKind::kFirst) {
    for (const PosePair& pair : pairs) moments.Add(pair);
  }
  return Align(moments, pairs.front(), kind, options);
}

void Apply(const Pose3& T_world_map, std::span<PosePair> pairs) {
  for (PosePair& pair : pairs) pair.estimate = T_world_map * pair.estimate;
}

std::string DescribeUnobservable(const Alignment& alignment) {
  const auto& axes = alignment.unobservable_axes;
  if (axes.empty()) return "";
  if (alignment.kind == AlignmentKind::kSe3 && axes.size() == 1) {
    return fmt::format("straight line: rotation about ({:.2f}, {:.2f}, {:.2f}) is not observable from positions",
                       axes[0].x(), axes[0].y(), axes[0].z());
  }
  const char* what = alignment.kind == AlignmentKind::kSe3 ? "rotation" : "yaw";
  return fmt::format("standing still: {} is not observable from positions", what);
}

}  // namespace lcmslam
