#include "sensor-bridge/sensor_publisher.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>

#include "bus/messages.h"
#include "bus/signals.h"
#include "bus/sweep_chunks.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kMountingPeriodUs = 1'000'000;
constexpr int64_t kUntimedSweepUs = 100'000;

bool HasTimes(const Sweep& sweep) {
  return std::ranges::any_of(sweep.points, [](const SweepPoint& p) { return p.dt_us != 0; });
}

// When its last point was measured; `has_times` says whether the sweep's points know that.
int64_t TimeOf(const point_cloud_chunk_t& chunk, bool has_times) {
  const int64_t chunks_after = chunk.num_chunks - 1 - chunk.chunk;
  if (!has_times || chunk.time_offset.empty()) return chunk.utime - kUntimedSweepUs * chunks_after / chunk.num_chunks;
  return chunk.utime + std::ranges::max(chunk.time_offset);
}

}  // namespace

void SensorPublisher::ExpectScans(int64_t scans) { progress_.emplace(static_cast<uint64_t>(scans), quiet_); }

void SensorPublisher::SetMounting(const std::string& lidar_channel, const Pose3& T_body_sensor) {
  mountings_[lidar_channel].T_body_sensor = T_body_sensor;
}

void SensorPublisher::PublishScan(const std::string& channel, const PlanarScan& scan) {
  Push(scan.utime, {Kind::kScan, channel, Encode(ToMessage(scan))});
}

void SensorPublisher::PublishSweep(const std::string& channel, const Sweep& sweep) {
  const bool has_times = HasTimes(sweep);
  for (const point_cloud_chunk_t& chunk : ToChunks(sweep, sweep_numbers_[channel]++)) {
    const bool is_last = chunk.chunk + 1 == chunk.num_chunks;
    Push(TimeOf(chunk, has_times), {Kind::kSweep, channel, Encode(chunk), is_last});
  }
}

void SensorPublisher::PublishImu(const std::string& channel, const ImuSample& sample) {
  if (!sample.angular_velocity_radps.allFinite() || !sample.specific_force_mps2.allFinite()) {
    ++invalid_samples_;
    return;
  }
  Push(sample.utime, {Kind::kImu, channel, Encode(ToMessage(sample))});
}

void SensorPublisher::PublishPacket(const std::string& channel, int64_t received_utime, uint16_t port,
                                    std::span<const uint8_t> payload) {
  lidar_packet_t packet{};
  packet.utime = received_utime;
  packet.num_bytes = static_cast<int32_t>(payload.size());
  packet.port = port;
  packet.payload.assign(payload.begin(), payload.end());
  Push(received_utime, {Kind::kPacket, channel, Encode(packet)});
}

void SensorPublisher::PublishAsIs(const std::string& channel, int64_t utime, std::vector<uint8_t> message) {
  Push(utime, {Kind::kOther, channel, std::move(message)});
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

void SensorPublisher::Flush() {
  order_.Flush([this](int64_t utime, const Message& message) { Emit(utime, message); });
}

void SensorPublisher::Finish() {
  Flush();
  progress_.reset();
}

std::string SensorPublisher::Summary() const {
  constexpr auto kNouns =
      std::to_array<std::string_view>({"scans", "poses", "sweeps", "IMU samples", "packets", "messages"});  // by Kind
  std::string line;
  for (const auto& [channel, count] : counts_)
    line += fmt::format("{} {} on {}, ", count.messages, kNouns[static_cast<size_t>(count.kind)], channel);
  if (invalid_poses_ > 0) line += fmt::format("{} invalid poses left out, ", invalid_poses_);
  if (invalid_samples_ > 0) line += fmt::format("{} invalid IMU samples left out, ", invalid_samples_);
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
  if (!message.counts) return;
  ++counts_.try_emplace(message.channel, Count{message.kind}).first->second.messages;
  ShowProgress(message.kind);
}

void SensorPublisher::ShowProgress(Kind kind) {
  const bool is_scan = kind == Kind::kScan || kind == Kind::kSweep;
  if (is_scan && progress_) progress_->Show(++scans_published_);
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
