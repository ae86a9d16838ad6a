#include "sensor-bridge/sensor_publisher.h"

#include <fmt/format.h>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>

#include "bus/messages.h"
#include "bus/signals.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kMountingPeriodUs = 1'000'000;

}  // namespace

void SensorPublisher::ExpectScans(int64_t scans) { progress_.emplace(static_cast<uint64_t>(scans), quiet_); }

void SensorPublisher::SetMounting(const std::string& lidar_channel, const Pose3& T_body_sensor) {
  mountings_[lidar_channel].T_body_sensor = T_body_sensor;
}

void SensorPublisher::PublishScan(const std::string& channel, const PlanarScan& scan) {
  Push(scan.utime, {Kind::kScan, channel, Encode(ToMessage(scan))});
}

void SensorPublisher::PublishPose(const std::string& channel, const StampedPose& pose) {
  if (!pose.pose.IsRigid()) {
    ++invalid_poses_;
    return;
  }
  StampedPose rigid = pose;
  rigid.pose.rotation.normalize();
  Push(pose.utime, {Kind::kPose, channel, Encode(ToMessage(rigid))});
}

void SensorPublisher::Finish() {
  order_.Flush([this](int64_t utime, const Message& message) { Emit(utime, message); });
  progress_.reset();
}

std::string SensorPublisher::Summary() const {
  std::string line;
  for (const auto& [channel, count] : counts_)
    line += fmt::format("{} {} on {}, ", count.messages, count.kind == Kind::kScan ? "scans" : "poses", channel);
  if (invalid_poses_ > 0) line += fmt::format("{} invalid poses left out, ", invalid_poses_);
  if (order_.jumps() > 0) line += fmt::format("time jumped back {} times, ", order_.jumps());
  return fmt::format("{}{:.1f} s", line, static_cast<double>(duration_us_) / 1e6);
}

void SensorPublisher::Push(int64_t utime, Message message) {
  order_.Push(utime, std::move(message), [this](int64_t t, const Message& next) { Emit(t, next); });
}

void SensorPublisher::Emit(int64_t utime, const Message& message) {
  if (StopRequested()) return;  // what is held back need not go out any more
  if (started_) duration_us_ += std::max<int64_t>(UtimeDifference(utime, last_utime_), 0);
  started_ = true;
  last_utime_ = utime;
  PublishMounting(utime, message.channel);
  output_.Publish(utime, message.channel, Bytes(message.data));
  ++counts_.try_emplace(message.channel, Count{message.kind}).first->second.messages;
  if (message.kind == Kind::kScan && progress_) progress_->Show(++scans_published_);
}

void SensorPublisher::PublishMounting(int64_t utime, const std::string& lidar_channel) {
  const auto found = mountings_.find(lidar_channel);
  if (found == mountings_.end()) return;
  Mounting& mounting = found->second;
  const int64_t age_us = UtimeDifference(utime, mounting.published_utime);
  if (mounting.published && age_us >= 0 && age_us < kMountingPeriodUs) return;
  output_.Publish(utime, lidar_channel + "_EXTRINSICS", ExtrinsicsMessage(utime, mounting.T_body_sensor));
  mounting.published = true;
  mounting.published_utime = utime;
}

}  // namespace lcmslam
