#include "trajectory/local_motion.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace lcmslam {

std::optional<LocalMotion> FitLocalMotion(std::span<const StampedPose> trajectory, int64_t utime, int64_t half_width_us,
                                          int64_t max_gap_us) {
  const auto nearest = InterpolateAt(trajectory, utime, max_gap_us);
  if (!nearest) return std::nullopt;
  const auto begin = std::ranges::lower_bound(trajectory, utime - half_width_us, {}, &StampedPose::utime);
  const auto end = std::ranges::upper_bound(begin, trajectory.end(), utime + half_width_us, {}, &StampedPose::utime);
  if (end - begin < 4 || begin->utime > utime || std::prev(end)->utime < utime) return std::nullopt;

  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 7> right_side = Eigen::Matrix<double, 3, 7>::Zero();
  for (const StampedPose& sample : std::span(begin, end)) {
    const double s = static_cast<double>(sample.utime - utime) / static_cast<double>(half_width_us);
    const Eigen::Vector3d powers(1.0, s, s * s);
    const Eigen::Vector4d q = sample.pose.rotation.coeffs();
    const double sign = q.dot(nearest->rotation.coeffs()) < 0.0 ? -1.0 : 1.0;  // q and -q are the same rotation
    Eigen::Matrix<double, 7, 1> values;
    values << sample.pose.translation - nearest->translation, sign * q;
    normal += powers * powers.transpose();
    right_side += powers * values.transpose();
  }
  const Eigen::Matrix<double, 3, 7> coefficients = normal.ldlt().solve(right_side);
  if (!coefficients.allFinite()) return std::nullopt;

  LocalMotion motion;
  motion.position = coefficients.leftCols<3>().transpose();
  motion.position.col(0) += nearest->translation;
  motion.quaternion = coefficients.rightCols<4>().transpose();
  motion.half_width_s = static_cast<double>(half_width_us) * 1e-6;
  return motion;
}

}  // namespace lcmslam
