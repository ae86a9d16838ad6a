#include "simulation/planar_motion.h"

namespace lcmslam {

PlanarMotion::PlanarMotion(int64_t start_utime, int64_t step_us, const Pose2& T_world_body_start,
                           std::vector<Eigen::Vector3d> twists)
    : start_utime_(start_utime), step_us_(step_us), twists_(std::move(twists)), T_world_body_{T_world_body_start} {
  const double step_s = 1e-6 * static_cast<double>(step_us);
  for (const Eigen::Vector3d& twist : twists_)
    T_world_body_.push_back(T_world_body_.back() * Pose2::Exp(twist * step_s));
}

Pose2 PlanarMotion::PoseAt(int64_t utime) const {
  if (utime <= start_utime_) return T_world_body_.front();
  if (utime >= end_utime()) return T_world_body_.back();
  const int64_t elapsed_us = utime - start_utime_;
  const auto step = static_cast<size_t>(elapsed_us / step_us_);
  const double into_step_s = 1e-6 * static_cast<double>(elapsed_us % step_us_);
  return T_world_body_[step] * Pose2::Exp(twists_[step] * into_step_s);
}

Eigen::Vector3d PlanarMotion::TwistAt(int64_t utime) const {
  if (utime < start_utime_ || utime >= end_utime()) return Eigen::Vector3d::Zero();
  return twists_[static_cast<size_t>((utime - start_utime_) / step_us_)];
}

}  // namespace lcmslam
