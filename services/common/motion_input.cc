#include "common/motion_input.h"

#include <algorithm>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kKeptUs = 3'000'000;
constexpr int64_t kMaxOdometryGapUs = 200'000;
constexpr int64_t kMaxImuGapUs = 30'000;

// Stamps in `readings` rise and span at most kKeptUs.
template <class Reading>
void Keep(const Reading& reading, std::deque<Reading>& readings) {
  if (!readings.empty()) {
    const int64_t step_us = UtimeDifference(reading.utime, readings.back().utime);
    if (step_us < -kKeptUs) {
      readings.clear();
    } else if (step_us <= 0) {
      return;
    }
  }
  readings.push_back(reading);
  while (UtimeDifference(reading.utime, readings.front().utime) > kKeptUs) readings.pop_front();
}

// The last reading at or before `utime`, and the end when there is none.
template <class Reading>
auto LastUntil(const std::deque<Reading>& readings, int64_t utime) {
  const auto after = std::ranges::upper_bound(readings, utime, {}, &Reading::utime);
  return after == readings.begin() ? readings.end() : after - 1;
}

// The pose at `utime`: between its neighbours, or not far beyond the last by the motion between the last two.
std::optional<Pose3> PoseAt(const std::deque<StampedPose>& poses, int64_t utime) {
  auto before = LastUntil(poses, utime);
  if (before == poses.end() || poses.size() < 2) return {};
  if (before + 1 == poses.end()) --before;
  const auto after = before + 1;
  const int64_t gap_us = UtimeDifference(after->utime, before->utime);
  const int64_t since_us = UtimeDifference(utime, before->utime);
  if (gap_us > kMaxOdometryGapUs || since_us > 2 * gap_us) return {};
  return Interpolate(before->pose, after->pose, static_cast<double>(since_us) / static_cast<double>(gap_us));
}

Eigen::Quaterniond Turned(const Eigen::Vector3d& rate_radps, int64_t duration_us) {
  const Eigen::Vector3d turn = rate_radps * (1e-6 * static_cast<double>(duration_us));
  return Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
}

}  // namespace

void MotionInput::AddOdometry(const StampedPose& T_odom_body) { Keep(T_odom_body, odometry_); }

void MotionInput::AddImu(const ImuSample& sample) { Keep(sample, imu_); }

LidarMotion MotionInput::Between(int64_t from_utime, int64_t to_utime) const {
  return {TurnBetween(from_utime, to_utime), OdometryBetween(from_utime, to_utime)};
}

std::optional<Pose3> MotionInput::OdometryBetween(int64_t from_utime, int64_t to_utime) const {
  const std::optional<Pose3> from = PoseAt(odometry_, from_utime);
  const std::optional<Pose3> to = PoseAt(odometry_, to_utime);
  if (!from || !to) return {};
  return (*from * T_body_lidar_).inverse() * (*to * T_body_lidar_);
}

// Each reading holds half way to the next.
std::optional<Eigen::Quaterniond> MotionInput::TurnBetween(int64_t from_utime, int64_t to_utime) const {
  auto reading = LastUntil(imu_, from_utime);
  if (reading == imu_.end()) return {};
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (int64_t utime = from_utime; utime < to_utime; ++reading) {
    const auto next = reading + 1;
    const bool last = next == imu_.end();
    const int64_t gap_us = UtimeDifference(last ? to_utime : next->utime, reading->utime);
    if (gap_us > kMaxImuGapUs) return {};
    const int64_t until = last ? to_utime : std::clamp(reading->utime + gap_us / 2, utime, to_utime);
    turn = turn * Turned(reading->angular_velocity_radps, until - utime);
    utime = until;
    if (last) break;
  }
  return T_body_lidar_.rotation.conjugate() * turn.normalized() * T_body_lidar_.rotation;
}

}  // namespace lcmslam
