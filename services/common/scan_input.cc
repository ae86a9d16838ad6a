#include "common/scan_input.h"

#include <optional>
#include <string_view>

#include "bus/messages.h"

namespace lcmslam {
namespace {

constexpr const char* kLidar = "LIDAR_2D";
constexpr std::string_view kFurtherLidars = "LIDAR_2D_";
constexpr std::string_view kExtrinsics = "_EXTRINSICS";

}  // namespace

ScanInput::ScanInput(std::string channel, bool mounting_configured, MountingHandler on_mounting, ScanHandler on_scan)
    : channel_(std::move(channel)),
      automatic_(channel_.empty()),
      gate_(
          mounting_configured,
          [on_mounting = std::move(on_mounting)](const Pose3& T_body_lidar) { on_mounting(ToPose2(T_body_lidar)); },
          std::move(on_scan)) {}

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
  gate_.Pass(*scan);
  return Handled::kAccepted;
}

Handled ScanInput::OfferExtrinsics(const Event& event) {
  const std::string_view lidar = std::string_view(event.channel).substr(0, event.channel.size() - kExtrinsics.size());
  if (gate_.known() || lidar != (channel_.empty() ? kLidar : channel_)) return Handled::kIgnored;
  const std::optional<Pose3> T_body_sensor = DecodeExtrinsics(event.data);
  if (!T_body_sensor) return Handled::kRefused;
  gate_.Settle(*T_body_sensor);
  return Handled::kAccepted;
}

}  // namespace lcmslam
