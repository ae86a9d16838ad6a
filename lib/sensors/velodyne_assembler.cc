#include "sensors/velodyne_assembler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kHour_us = 3'600'000'000;
constexpr int64_t kLongestSweep_us = 1'000'000;
constexpr int64_t kLargestDrift_us = 1'000'000;   // of the sensor's clock from one packet to the next
constexpr int64_t kLongestStall_us = 10'000'000;  // of the receiver, while packets wait in the kernel

}  // namespace

std::vector<Sweep> VelodyneAssembler::Add(const VelodynePacket& packet, std::optional<int64_t> received_utime) {
  std::vector<Sweep> complete;
  const auto complete_begun = [&] {
    if (std::optional<Sweep> sweep = Finish()) complete.push_back(*std::move(sweep));
  };
  packet_utime_ = Unwrap(packet.stamp_us, received_utime);
  for (const VelodynePoint& p : packet.points) {
    const int64_t utime = packet_utime_ + std::llround(p.delay_us);
    const bool jumped = begun_ && !begun_->utimes.empty() &&
                        (utime < begun_->utimes.back() || utime - begun_->utimes.front() >= kLongestSweep_us);
    const bool cut = last_azimuth_rad_ - p.azimuth_rad > std::numbers::pi;
    if (jumped || cut) complete_begun();
    if (cut) begun_.emplace();
    last_azimuth_rad_ = p.azimuth_rad;
    if (!begun_) continue;
    begun_->utimes.push_back(utime);
    begun_->points.push_back(
        {.x = p.p_lidar.x(), .y = p.p_lidar.y(), .z = p.p_lidar.z(), .intensity = p.intensity, .ring = p.ring});
  }
  return complete;
}

std::optional<Sweep> VelodyneAssembler::Finish() {
  std::optional<Begun> begun = std::exchange(begun_, std::nullopt);
  if (!begun || begun->points.empty()) return std::nullopt;
  Sweep sweep{.utime = begun->utimes.back(), .points = std::move(begun->points)};
  for (size_t i = 0; i < sweep.points.size(); ++i) {
    sweep.points[i].dt_us = static_cast<int32_t>(begun->utimes[i] - sweep.utime);
  }
  return sweep;
}

// The hour may end between two packets, and the sensor may find or lose its GPS.
int64_t VelodyneAssembler::Unwrap(uint32_t stamp_us, std::optional<int64_t> received_utime) {
  const std::optional<uint32_t> last_stamp_us = std::exchange(last_stamp_us_, stamp_us);
  const std::optional<int64_t> last_received_utime = std::exchange(received_utime_, received_utime);
  if (!last_stamp_us) return received_utime.value_or(stamp_us);
  int64_t elapsed_us = int64_t{stamp_us} - int64_t{*last_stamp_us};
  if (elapsed_us < -kHour_us / 2) elapsed_us += kHour_us;
  if (!received_utime || !last_received_utime) return packet_utime_ + elapsed_us;
  const int64_t received_elapsed_us = std::max<int64_t>(UtimeDifference(*received_utime, *last_received_utime), 0);
  const bool was_set = elapsed_us > received_elapsed_us + kLargestDrift_us ||
                       elapsed_us < std::max<int64_t>(received_elapsed_us - kLongestStall_us, 0) - kLargestDrift_us;
  return was_set ? *received_utime : packet_utime_ + elapsed_us;
}

}  // namespace lcmslam
