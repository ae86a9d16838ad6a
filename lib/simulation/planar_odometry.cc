#include "simulation/planar_odometry.h"

#include <cmath>

#include <boost/random/normal_distribution.hpp>

#include "simulation/random.h"

namespace lcmslam {

std::string PlanarOdometryOptions::Validate() const {
  const auto is_bad = [](double value) { return !(value >= 0.0) || !std::isfinite(value); };
  if (is_bad(rate_hz) || rate_hz > 1e3) return "rate_hz: must be in 0..1000";
  if (is_bad(translation_scale_sigma)) return "translation_scale_sigma: must not be negative";
  if (is_bad(rotation_scale_sigma)) return "rotation_scale_sigma: must not be negative";
  if (is_bad(translation_walk_m_per_sqrt_m)) return "translation_walk_m_per_sqrt_m: must not be negative";
  if (is_bad(rotation_walk_rad_per_sqrt_m)) return "rotation_walk_rad_per_sqrt_m: must not be negative";
  if (is_bad(rotation_walk_rad_per_sqrt_rad)) return "rotation_walk_rad_per_sqrt_rad: must not be negative";
  return "";
}

std::vector<OdometrySample> SimulateOdometry(const PlanarMotion& motion, const PlanarOdometryOptions& options,
                                             uint64_t seed) {
  std::vector<OdometrySample> samples;
  if (options.rate_hz == 0.0) return samples;
  Rng rng = MakeRng(seed, RandomStream::kOdometry);
  boost::random::normal_distribution<double> normal;
  const double translation_scale = 1.0 + options.translation_scale_sigma * normal(rng);
  const double rotation_scale = 1.0 + options.rotation_scale_sigma * normal(rng);

  samples.push_back({.utime = motion.start_utime()});
  while (true) {
    const OdometrySample& last = samples.back();
    const auto elapsed_us = std::llround(1e6 * static_cast<double>(samples.size()) / options.rate_hz);
    const int64_t utime = motion.start_utime() + elapsed_us;
    if (utime > motion.end_utime()) return samples;
    const Eigen::Vector3d moved = (motion.PoseAt(last.utime).inverse() * motion.PoseAt(utime)).Log();
    const double way_m = moved.head<2>().norm();
    const double turn_rad = std::abs(moved.z());
    const double translation_sigma = options.translation_walk_m_per_sqrt_m * std::sqrt(way_m);
    const double rotation_sigma = std::hypot(options.rotation_walk_rad_per_sqrt_m * std::sqrt(way_m),
                                             options.rotation_walk_rad_per_sqrt_rad * std::sqrt(turn_rad));
    const Eigen::Vector3d measured(translation_scale * moved.x() + translation_sigma * normal(rng),
                                   translation_scale * moved.y() + translation_sigma * normal(rng),
                                   rotation_scale * moved.z() + rotation_sigma * normal(rng));
    const double interval_s = 1e-6 * static_cast<double>(utime - last.utime);
    samples.push_back({utime, last.T_odom_body * Pose2::Exp(measured), measured / interval_s});
  }
}

}  // namespace lcmslam
