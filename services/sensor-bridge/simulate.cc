#include "sensor-bridge/simulate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bus/signals.h"
#include "sensor-bridge/lidar_channels.h"

namespace lcmslam {
namespace {

std::optional<PoseBound> BoundOf(const PlanarFrame& frame) {
  if (!frame.bound) return {};
  return PoseBound{PositionBound(*frame.bound), std::sqrt((*frame.bound)(2, 2))};
}

std::optional<PoseBound> BoundOf(const SpatialFrame& frame) {
  if (!frame.bound) return {};
  const auto variances = frame.bound->diagonal();
  return PoseBound{std::sqrt(variances.head<3>().sum()), std::sqrt(variances.tail<3>().sum())};
}

}  // namespace

void PublishEpisode(const PlanarEpisode& episode, SensorPublisher& publisher, BoundSummary& bound) {
  publisher.SetMounting(kMainLidarChannel, ToPose3(episode.options().lidar.T_body_lidar));
  auto odometry = episode.odometry().begin();
  for (int i = 0; i < episode.num_frames() && !StopRequested(); ++i) {
    const PlanarFrame frame = episode.Frame(i);
    for (; odometry != episode.odometry().end() && odometry->utime <= frame.scan.utime; ++odometry) {
      publisher.PublishPose(kOdometryChannel, {odometry->utime, ToPose3(odometry->T_odom_body)});
    }
    publisher.PublishPose(kGroundTruthChannel, {frame.scan.utime, ToPose3(frame.T_world_body)});
    publisher.PublishScan(kMainLidarChannel, frame.scan);
    bound.Add(frame.scan.utime, BoundOf(frame));
  }
}

void PublishEpisode(const SpatialEpisode& episode, SensorPublisher& publisher, BoundSummary& bound) {
  publisher.SetMounting(kMultiLineChannel, episode.options().lidar.T_body_lidar);
  auto imu = episode.imu().begin();
  auto odometry = episode.odometry().begin();
  for (int i = 0; i < episode.num_frames() && !StopRequested(); ++i) {
    const SpatialFrame frame = episode.Frame(i);
    for (; imu != episode.imu().end() && imu->utime <= frame.sweep.utime; ++imu) {
      publisher.PublishImu(kImuChannel, *imu);
    }
    for (; odometry != episode.odometry().end() && odometry->utime <= frame.sweep.utime; ++odometry) {
      publisher.PublishPose(kOdometryChannel, *odometry);
    }
    publisher.PublishPose(kGroundTruthChannel, {frame.sweep.utime, frame.T_world_body});
    publisher.PublishSweep(kMultiLineChannel, frame.sweep);
    bound.Add(frame.sweep.utime, BoundOf(frame));
  }
}

BoundSummary::BoundSummary(std::ostream* csv) : csv_(csv) {
  if (csv_ != nullptr) *csv_ << "utime_us,position_m,rotation_rad\n";
}

void BoundSummary::Add(int64_t utime, const std::optional<PoseBound>& bound) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const PoseBound row = bound.value_or(PoseBound{kNone, kNone});
  if (csv_ != nullptr) *csv_ << fmt::format("{},{:.6g},{:.6g}\n", utime, row.position_m, row.rotation_rad);
  if (!bound) {
    ++unbounded_;
    return;
  }
  ++bounded_;
  sum_position_m_ += bound->position_m;
  sum_rotation_rad_ += bound->rotation_rad;
}

std::string BoundSummary::Line() const {
  const int64_t scans = bounded_ + unbounded_;
  if (bounded_ == 0) return fmt::format("Cramer-Rao bound of one scan: none of {} fixes the pose", scans);
  const double count = static_cast<double>(bounded_);
  return fmt::format("Cramer-Rao bound of one scan: position {:.3f} mm, rotation {:.3f} mrad; mean of {}",
                     1e3 * sum_position_m_ / count, 1e3 * sum_rotation_rad_ / count, bounded_) +
         (unbounded_ == 0 ? "" : fmt::format(" of {}, the rest do not fix the pose", scans));
}

}  // namespace lcmslam
