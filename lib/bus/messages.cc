#include "bus/messages.h"

#include <algorithm>
#include <cmath>

#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

// Beam times further than this from the scan's stamp are not times (some drivers leave them 0).
constexpr int64_t kMaxScanDurationUs = 10'000'000;

bool Near(int64_t stamp, int64_t time) {
  const int64_t difference_us = UtimeDifference(stamp, time);
  return difference_us <= kMaxScanDurationUs && difference_us >= -kMaxScanDurationUs;
}

PlanarScan ToScan(const planar_scan_t& message, std::optional<AngleSense> known_sense) {
  PlanarScan scan;
  scan.utime = message.utime;
  const bool timed = std::ranges::all_of(message.times, [&](int64_t t) { return Near(message.utime, t); });
  if (timed && !message.times.empty()) scan.utime = std::ranges::max(message.times);
  const AngleSense sense = known_sense.value_or(DetectAngleSense(message.utime, message.times, message.thetas));
  const float sign = sense == AngleSense::kClockwise ? -1.0F : 1.0F;
  scan.beams.resize(message.ranges.size());
  for (size_t i = 0; i < scan.beams.size(); ++i) {
    const int32_t dt_us = timed ? static_cast<int32_t>(message.times[i] - scan.utime) : 0;
    scan.beams[i] = {message.ranges[i], sign * message.thetas[i], dt_us};
  }
  return scan;
}

PlanarScan ToScan(const planar_lidar_t& message) {
  PlanarScan scan;
  scan.utime = message.utime;
  scan.beams.resize(message.ranges.size());
  for (size_t i = 0; i < scan.beams.size(); ++i) {
    scan.beams[i] = {message.ranges[i], message.rad0 + static_cast<float>(i) * message.radstep, 0};
  }
  return scan;
}

// None unless finite and with a quaternion of about unit length.
std::optional<Pose3> ToPose(const double position[3], const double wxyz[4]) {
  Pose3 pose{{position[0], position[1], position[2]}, {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}};
  if (!pose.IsRigid()) return {};
  pose.rotation.normalize();
  return pose;
}

void FromPose(const Pose3& pose, double position[3], double wxyz[4]) {
  std::copy_n(pose.translation.data(), 3, position);
  wxyz[0] = pose.rotation.w();
  std::copy_n(pose.rotation.vec().data(), 3, wxyz + 1);
}

}  // namespace

bool IsScan(Bytes message) {
  const int64_t type = Fingerprint(message);
  return type == planar_scan_t::getHash() || type == planar_lidar_t::getHash();
}

std::optional<PlanarScan> DecodeScan(Bytes message, std::optional<AngleSense> sense) {
  if (const auto scan = Decode<planar_scan_t>(message)) return ToScan(*scan, sense);
  if (const auto scan = Decode<planar_lidar_t>(message)) return ToScan(*scan);
  return {};
}

planar_scan_t ToMessage(const PlanarScan& scan) {
  planar_scan_t message;
  message.utime = scan.utime;
  message.num_ranges = static_cast<int32_t>(scan.beams.size());
  for (const Beam& beam : scan.beams) {
    message.ranges.push_back(beam.range_m);
    message.thetas.push_back(beam.angle_rad);
    message.times.push_back(scan.utime + beam.dt_us);
    message.intensities.push_back(0.0F);
  }
  return message;
}

bool IsPose(Bytes message) {
  const int64_t type = Fingerprint(message);
  return type == pose_t::getHash() || type == pose_xyt_t::getHash();
}

std::optional<StampedPose> DecodePose(Bytes message) {
  if (const auto full = Decode<pose_t>(message)) {
    const auto pose = ToPose(full->pos, full->orientation);
    if (pose) return StampedPose{full->utime, *pose};
  }
  if (const auto planar = Decode<pose_xyt_t>(message)) {
    const Pose2 pose(planar->x, planar->y, planar->theta);
    if (pose.IsFinite()) return StampedPose{planar->utime, ToPose3(pose)};
  }
  return {};
}

pose_t ToMessage(const StampedPose& pose) {
  pose_t message{};
  message.utime = pose.utime;
  FromPose(pose.pose, message.pos, message.orientation);
  return message;
}

std::optional<Pose3> DecodeExtrinsics(Bytes message) {
  const auto transform = Decode<rigid_transform_t>(message);
  return transform ? ToPose(transform->trans, transform->quat) : std::nullopt;
}

rigid_transform_t ExtrinsicsMessage(int64_t utime, const Pose3& T_body_sensor) {
  rigid_transform_t message{};
  message.utime = utime;
  FromPose(T_body_sensor, message.trans, message.quat);
  return message;
}

}  // namespace lcmslam
