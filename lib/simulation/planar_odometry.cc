#include "simulation/planar_odometry.h"

#include <cmath>

namespace lcmslam {

std::vector<OdometrySample> SimulateOdometry(const PlanarMotion& motion, const OdometryOptions& options,
                                             uint64_t seed) {
  std::vector<OdometrySample> samples;
  if (options.rate_hz == 0.0) return samples;
  OdometryDrift drift(options, seed);
  samples.push_back({.utime = motion.start_utime()});
  while (true) {
    const OdometrySample& last = samples.back();
    const auto elapsed_us = std::llround(1e6 * static_cast<double>(samples.size()) / options.rate_hz);
    const int64_t utime = motion.start_utime() + elapsed_us;
    if (utime > motion.end_utime()) return samples;
    const Eigen::Vector3d moved = (motion.PoseAt(last.utime).inverse() * motion.PoseAt(utime)).Log();
    const Eigen::Vector3d measured = drift.MeasurePlanar(moved);
    const double interval_s = 1e-6 * static_cast<double>(utime - last.utime);
    samples.push_back({utime, last.T_odom_body * Pose2::Exp(measured), measured / interval_s});
  }
}

}  // namespace lcmslam
