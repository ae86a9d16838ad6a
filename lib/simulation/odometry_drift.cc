#include "simulation/odometry_drift.h"

#include <cmath>

namespace lcmslam {

std::string OdometryOptions::Validate() const {
  const auto is_bad = [](double value) { return !(value >= 0.0) || !std::isfinite(value); };
  if (is_bad(rate_hz) || rate_hz > 1e3) return "rate_hz: must be in 0..1000";
  if (is_bad(translation_scale_sigma)) return "translation_scale_sigma: must not be negative";
  if (is_bad(rotation_scale_sigma)) return "rotation_scale_sigma: must not be negative";
  if (is_bad(translation_walk_m_per_sqrt_m)) return "translation_walk_m_per_sqrt_m: must not be negative";
  if (is_bad(rotation_walk_rad_per_sqrt_m)) return "rotation_walk_rad_per_sqrt_m: must not be negative";
  if (is_bad(rotation_walk_rad_per_sqrt_rad)) return "rotation_walk_rad_per_sqrt_rad: must not be negative";
  return "";
}

OdometryDrift::OdometryDrift(const OdometryOptions& options, uint64_t seed)
    : options_(options),
      rng_(MakeRng(seed, RandomStream::kOdometry)),
      translation_scale_(1.0 + options.translation_scale_sigma * normal_(rng_)),
      rotation_scale_(1.0 + options.rotation_scale_sigma * normal_(rng_)) {}

Eigen::Vector3d OdometryDrift::MeasurePlanar(const Eigen::Vector3d& moved) { return Measure<2, 1>(moved); }

Eigen::Matrix<double, 6, 1> OdometryDrift::MeasureSpatial(const Eigen::Matrix<double, 6, 1>& moved) {
  return Measure<3, 3>(moved);
}

template <int kAxes, int kAngles>
Eigen::Matrix<double, kAxes + kAngles, 1> OdometryDrift::Measure(
    const Eigen::Matrix<double, kAxes + kAngles, 1>& moved) {
  const double way_m = moved.template head<kAxes>().norm();
  const double turn_rad = moved.template tail<kAngles>().norm();
  const double translation_sigma = options_.translation_walk_m_per_sqrt_m * std::sqrt(way_m);
  const double rotation_sigma = std::hypot(options_.rotation_walk_rad_per_sqrt_m * std::sqrt(way_m),
                                           options_.rotation_walk_rad_per_sqrt_rad * std::sqrt(turn_rad));
  Eigen::Matrix<double, kAxes + kAngles, 1> measured;
  for (int i = kAxes + kAngles - 1; i >= 0; --i) {
    const bool is_axis = i < kAxes;
    measured[i] = (is_axis ? translation_scale_ : rotation_scale_) * moved[i] +
                  (is_axis ? translation_sigma : rotation_sigma) * normal_(rng_);
  }
  return measured;
}

}  // namespace lcmslam
