#include "simulation/spatial_odometry.h"

#include <cmath>

#include <Eigen/Geometry>

namespace lcmslam {
namespace {

using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d StepOf(const Pose3& T_before_after) {
  const Eigen::AngleAxisd turn(T_before_after.rotation);
  Vector6d step;
  step << T_before_after.translation, turn.angle() * turn.axis();
  return step;
}

Pose3 PoseOf(const Vector6d& step) {
  const Vector3d turn = step.tail<3>();
  return {step.head<3>(), Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()))};
}

}  // namespace

Trajectory SimulateSpatialOdometry(const SpatialMotion& motion, int64_t start_utime, const OdometryOptions& options,
                                   uint64_t seed) {
  Trajectory odometry;
  if (options.rate_hz == 0.0) return odometry;
  OdometryDrift drift(options, seed);
  odometry.push_back({start_utime, {}});
  Pose3 T_world_before = motion.PoseAt(0.0);
  for (int64_t i = 1;; ++i) {
    const double t_s = static_cast<double>(i) / options.rate_hz;
    if (t_s > motion.duration_s()) return odometry;
    const Pose3 T_world_body = motion.PoseAt(t_s);
    const Vector6d measured = drift.MeasureSpatial(StepOf(T_world_before.inverse() * T_world_body));
    Pose3 T_odom_body = odometry.back().pose * PoseOf(measured);
    T_odom_body.rotation.normalize();
    odometry.push_back({start_utime + std::llround(1e6 * t_s), T_odom_body});
    T_world_before = T_world_body;
  }
}

}  // namespace lcmslam
