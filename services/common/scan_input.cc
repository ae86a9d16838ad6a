#include "common/scan_input.h"

#include <string_view>

#include "bus/messages.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr const char* kLidar = "LIDAR_2D";
constexpr std::string_view kFurtherLidars = "LIDAR_2D_";
constexpr std::string_view kExtrinsics = "_EXTRINSICS";
constexpr int64_t kMountingWaitUs = 1'500'000;

}  // namespace

ScanInput::ScanInput(std::string channel, bool mounting_configured, MountingHandler on_mounting, ScanHandler on_scan)
    : channel_(std::move(channel)),
      automatic_(channel_.empty()),
      mounting_known_(mounting_configured),
      on_mounting_(std::move(on_mounting)),
      on_scan_(std::move(on_scan)) {}

// Whether the event comes from our lidar, which the first good scan may decide.
bool ScanInput::Adopt(const Event& event) {
  if (automatic_ && channel_.empty() && !event.channel.starts_with(kFurtherLidars) && DecodeScan(event.data)) {
    channel_ = event.channel;
  }
  return event.channel == (channel_.empty() ? kLidar : channel_);
}

Handled ScanInput::Offer(const Event& event) {
  if (event.channel.ends_with(kExtrinsics)) return OfferExtrinsics(event);
  if (!Adopt(event)) return Handled::kIgnored;
  const std::optional<PlanarScan> scan = DecodeScan(event.data);
  if (!scan) return Handled::kRefused;
  if (mounting_known_) {
    on_scan_(*scan);
    return Handled::kAccepted;
  }
  waiting_.push_back(*scan);
  const int64_t waited_us = UtimeDifference(scan->utime, waiting_.front().utime);
  if (waited_us < 0 || waited_us > kMountingWaitUs) SettleMounting(Pose2());
  return Handled::kAccepted;
}

Handled ScanInput::OfferExtrinsics(const Event& event) {
  const std::string_view lidar = std::string_view(event.channel).substr(0, event.channel.size() - kExtrinsics.size());
  if (mounting_known_ || lidar != (channel_.empty() ? kLidar : channel_)) return Handled::kIgnored;
  const std::optional<Pose3> T_body_sensor = DecodeExtrinsics(event.data);
  if (!T_body_sensor) return Handled::kRefused;
  SettleMounting(ToPose2(*T_body_sensor));
  return Handled::kAccepted;
}

void ScanInput::SettleMounting(const Pose2& T_body_lidar) {
  mounting_known_ = true;
  on_mounting_(T_body_lidar);
  for (const PlanarScan& scan : waiting_) on_scan_(scan);
  waiting_ = {};
}

void ScanInput::Flush() {
  if (!mounting_known_) SettleMounting(Pose2());
}

}  // namespace lcmslam
