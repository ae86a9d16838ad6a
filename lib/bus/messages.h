#pragma once

#include <cstdint>
#include <optional>

#include "bus/wire.h"
#include "geometry/trajectory.h"
#include "lidar/angle_sense.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

class planar_scan_t;
class pose_t;
class rigid_transform_t;

// Message <-> value. A Decode... returns none when the bytes are malformed, of another type, or carry a pose that is
// no pose (non-finite, quaternion far from unit length). Any thread.

// planar_scan_t (= MBot's lidar_t) or bot_core's planar_lidar_t, told apart by fingerprint.
bool IsScan(Bytes message);
// Angles come out counter-clockwise; `sense` says how planar_scan_t counts them, none: DetectAngleSense.
std::optional<PlanarScan> DecodeScan(Bytes message, std::optional<AngleSense> sense = {});
planar_scan_t ToMessage(const PlanarScan& scan);

// pose_t (= bot_core's) or MBot's pose_xyt_t, told apart by fingerprint.
bool IsPose(Bytes message);
std::optional<StampedPose> DecodePose(Bytes message);
pose_t ToMessage(const StampedPose& pose);

// T_body_sensor.
std::optional<Pose3> DecodeExtrinsics(Bytes message);
rigid_transform_t ExtrinsicsMessage(int64_t utime, const Pose3& T_body_sensor);

}  // namespace lcmslam
