#include "sensor-bridge/simulate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bus/signals.h"
#include "sensor-bridge/lidar_channels.h"

namespace lcmslam {

void PublishEpisode(const PlanarEpisode& episode, SensorPublisher& publisher,
                    const std::function<void(const PlanarFrame&)>& on_frame) {
  publisher.SetMounting(kMainLidarChannel, ToPose3(episode.options().lidar.T_body_lidar));
  auto odometry = episode.odometry().begin();
  for (int i = 0; i < episode.num_frames() && !StopRequested(); ++i) {
    const PlanarFrame frame = episode.Frame(i);
    for (; odometry != episode.odometry().end() && odometry->utime <= frame.scan.utime; ++odometry) {
      publisher.PublishPose(kOdometryChannel, {odometry->utime, ToPose3(odometry->T_odom_body)});
    }
    publisher.PublishPose(kGroundTruthChannel, {frame.scan.utime, ToPose3(frame.T_world_body)});
    publisher.PublishScan(kMainLidarChannel, frame.scan);
    on_frame(frame);
  }
}

void BoundSummary::Add(const PlanarFrame& frame) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double position_m = frame.bound ? PositionBound(*frame.bound) : kNone;
  const double yaw_rad = frame.bound ? std::sqrt((*frame.bound)(2, 2)) : kNone;
  csv_ += fmt::format("{},{:.6g},{:.6g}\n", frame.scan.utime, position_m, yaw_rad);
  if (!frame.bound) {
    ++unbounded_;
    return;
  }
  ++bounded_;
  sum_position_m_ += position_m;
  sum_yaw_rad_ += yaw_rad;
}

std::string BoundSummary::Line() const {
  const int64_t scans = bounded_ + unbounded_;
  if (bounded_ == 0) return fmt::format("Cramer-Rao bound of one scan: none of {} fixes the pose", scans);
  const double count = static_cast<double>(bounded_);
  return fmt::format("Cramer-Rao bound of one scan: position {:.3f} mm, rotation {:.3f} mrad; mean of {}",
                     1e3 * sum_position_m_ / count, 1e3 * sum_yaw_rad_ / count, bounded_) +
         (unbounded_ == 0 ? "" : fmt::format(" of {}, the rest do not fix the pose", scans));
}

}  // namespace lcmslam
