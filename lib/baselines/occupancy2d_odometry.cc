#include "baselines/occupancy2d_odometry.h"

#include <algorithm>
#include <utility>

namespace lcmslam::occupancy2d {
namespace {

constexpr int64_t kMaxGap_us = 250'000;
constexpr size_t kMaxSamples = 10'000;  // more means that no scans come

}  // namespace

void OdometryGuess::Add(int64_t utime, const Pose2& T_odom_body) {
  if (!T_odom_body.IsFinite()) return;
  if (!T_odom_body_.empty() && utime == T_odom_body_.back().utime) return;
  if (!T_odom_body_.empty() && utime < T_odom_body_.back().utime) *this = {};
  if (T_odom_body_.size() == kMaxSamples) T_odom_body_.clear();
  T_odom_body_.push_back({utime, ToPose3(T_odom_body)});
}

Pose2 OdometryGuess::MotionUntil(int64_t utime) {
  const std::optional<Pose2> before = std::exchange(T_odom_body_before_, At(utime));
  const auto after = std::ranges::lower_bound(T_odom_body_, utime, {}, &StampedPose::utime);
  if (after != T_odom_body_.begin()) T_odom_body_.erase(T_odom_body_.begin(), std::prev(after));
  return before && T_odom_body_before_ ? before->inverse() * *T_odom_body_before_ : Pose2();
}

// Scans often come before the odometry that follows them: then the last sample stands for now.
std::optional<Pose2> OdometryGuess::At(int64_t utime) const {
  if (T_odom_body_.empty()) return std::nullopt;
  const StampedPose& last = T_odom_body_.back();
  if (utime > last.utime && utime - last.utime <= kMaxGap_us) return ToPose2(last.pose);
  const std::optional<Pose3> between = InterpolateAt(T_odom_body_, utime, kMaxGap_us);
  return between ? std::optional(ToPose2(*between)) : std::nullopt;
}

}  // namespace lcmslam::occupancy2d
