#include "octo3d/plane_constraints.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lcmslam::octo3d {

namespace {

constexpr float kInlier = 3.0F;        // standard deviations
constexpr float kMaxThickness = 1.1F;  // of a patch across the plane it is matched to, in range_noise_m
constexpr float kReuseM = 0.01F;       // a patch that moved less keeps its plane

float Square(double v) { return static_cast<float>(v * v); }

// Skew(a) b = a x b
Eigen::Matrix3d Skew(const Eigen::Vector3d& a) {
  return (Eigen::Matrix3d() << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0).finished();
}

}  // namespace

PlaneConstraints::PlaneConstraints(const SurfelMap& map, std::span<const Patch> patches,
                                   const RegistrationOptions& options, const Eigen::Vector3d& origin)
    : map_(map),
      patches_(patches),
      origin_(origin),
      kernel_(static_cast<float>(options.kernel)),
      range_var_(Square(map.options().range_noise_m)),
      model_var_(Square(options.model_error_m)),
      constraints_(patches.size()) {
  for (size_t i = 0; i < patches.size(); ++i) {
    const Patch& patch = patches[i];
    Constraint& c = constraints_[i];
    c.mean = patch.mean.cast<float>();
    c.mean_var = range_var_ / patch.count;
    // The variance of a sample of n varies by sqrt(2 / n) of itself.
    c.max_across_var = kMaxThickness * kMaxThickness * range_var_ * (1.0F + 2.0F * std::sqrt(2.0F / patch.count));
    c.slot = patch.slot;
  }
}

ConstraintFit PlaneConstraints::AddTo(SweepInformation& information, const PoseTable& poses, double kernel_floor_m) {
  SetPoses(poses);
  ConstraintFit fit;
  for (size_t first = 0; first < constraints_.size(); first += kBatch) {
    const size_t size = std::min(kBatch, constraints_.size() - first);
    const std::span<Constraint> batch(&constraints_[first], size);
    Locate(batch);
    AssociateMoved(batch, patches_.subspan(first, size));
    const size_t num_equations = Linearize(batch, static_cast<float>(kernel_floor_m), fit);
    for (const Equation& e : std::span(equations_).first(num_equations)) {
      information.Add(e.slot, e.normal, e.moment, e.residual, e.weight);
    }
  }
  return fit;
}

void PlaneConstraints::SetPoses(const PoseTable& poses) {
  T_local_lidar_.assign(poses.size(), Eigen::Matrix4f::Identity());
  for (size_t slot = 0; slot < poses.size(); ++slot) {
    const PoseTable::Entry& pose = poses[static_cast<int>(slot)];
    T_local_lidar_[slot].topLeftCorner<3, 3>() = pose.R_map_lidar.cast<float>();
    T_local_lidar_[slot].topRightCorner<3, 1>() = (pose.t_map_lidar - origin_).cast<float>();
  }
}

void PlaneConstraints::Locate(std::span<const Constraint> batch) {
  for (size_t k = 0; k < batch.size(); ++k) {
    const Constraint& c = batch[k];
    const Eigen::Matrix4f& T = T_local_lidar_[c.slot];
    const Eigen::Vector4f lever = T.col(0) * c.mean[0] + T.col(1) * c.mean[1] + T.col(2) * c.mean[2];
    places_[k] = {lever + T.col(3), lever};
  }
}

void PlaneConstraints::AssociateMoved(std::span<Constraint> batch, std::span<const Patch> patches) {
  size_t size = 0;
  for (size_t k = 0; k < batch.size(); ++k) {
    const Eigen::Vector3f p = places_[k].local.head<3>();
    if ((p - batch[k].asked).squaredNorm() <= kReuseM * kReuseM) continue;
    batch[k].asked = p;
    moved_[size] = k;
    asked_[size++] = origin_ + p.cast<double>();
  }
  map_.Find(std::span(asked_).first(size), std::span(planes_).first(size));
  for (size_t i = 0; i < size; ++i) Associate(batch[moved_[i]], patches[moved_[i]], planes_[i]);
}

void PlaneConstraints::Associate(Constraint& c, const Patch& patch, const PlaneMatch& plane) const {
  const Eigen::Vector3f normal = plane.normal.cast<float>();
  const Eigen::Vector3f normal_lidar = T_local_lidar_[c.slot].topLeftCorner<3, 3>().transpose() * normal;
  c.information = 0.0F;
  if (!plane.found) return;
  // A patch lies along its plane, not across it, as a piece of floor found next to a wall does.
  if (normal_lidar.dot(patch.covariance * normal_lidar) > c.max_across_var) return;
  const auto height = static_cast<float>(plane.normal.dot(plane.mean - origin_));
  c.plane = {normal.x(), normal.y(), normal.z(), -height};
  const float plane_var = static_cast<float>(plane.variance) + model_var_;
  c.sigma = std::sqrt(range_var_ + plane_var);
  c.information = 1.0F / (c.mean_var + plane_var);
  c.tilt_var = static_cast<float>(plane.tilt_variance);
}

// A patch at the border of its surface may hold one side of the noise only: judge it by the noise of single points.
float PlaneConstraints::Weight(const Constraint& c, float residual, float kernel_floor_m) const {
  const float kernel = kernel_ * c.sigma + kernel_floor_m;
  const float ratio = kernel * kernel / (kernel * kernel + residual * residual);
  return ratio * ratio * c.information;
}

// Returns how many equations there are.
size_t PlaneConstraints::Linearize(std::span<const Constraint> batch, float kernel_floor_m, ConstraintFit& fit) {
  size_t size = 0;
  for (size_t k = 0; k < batch.size(); ++k) {
    const Constraint& c = batch[k];
    if (c.information <= 0.0F) continue;
    const float residual = c.plane.dot(places_[k].local);
    equations_[size++] = {c.plane, places_[k].lever.cross3(c.plane), residual, Weight(c, residual, kernel_floor_m),
                          c.slot};
    const bool inlier = std::abs(residual) < kInlier * c.sigma + kernel_floor_m;
    const float square = inlier ? residual * residual : 0.0F;
    fit.inliers += inlier;
    fit.squares += square;
    fit.normalized += square / (c.sigma * c.sigma);
  }
  fit.matched += static_cast<int>(size);
  return size;
}

// J = M n with M = (I, [lever]x). A normal that is off by noise of variance v along its plane adds v M (I - n n^T) M^T.
Matrix6 PlaneConstraints::NoiseOfNormals(double kernel_floor_m) {
  Matrix6 noise = Matrix6::Zero();
  for (size_t first = 0; first < constraints_.size(); first += kBatch) {
    const std::span<const Constraint> batch(&constraints_[first], std::min(kBatch, constraints_.size() - first));
    Locate(batch);
    for (size_t k = 0; k < batch.size(); ++k) {
      const Constraint& c = batch[k];
      if (c.information <= 0.0F) continue;
      const float weight = Weight(c, c.plane.dot(places_[k].local), static_cast<float>(kernel_floor_m));
      const Eigen::Vector3d n = c.plane.head<3>().cast<double>(), lever = places_[k].lever.head<3>().cast<double>();
      Eigen::Matrix<double, 6, 3> M;
      M << Eigen::Matrix3d::Identity(), Skew(lever);
      noise += weight * c.tilt_var * (M * M.transpose() - (M * n) * (M * n).transpose());
    }
  }
  return noise;
}

}  // namespace lcmslam::octo3d
