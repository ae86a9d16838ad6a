#pragma once

#include <cstdint>
#include <span>

namespace lcmslam {

// Which way the angles of a scan count, seen from above.
enum class AngleSense { kCounterClockwise, kClockwise };

// The sense of an MBot-type scan (planar_scan_t = lidar_t), which does not say it.
// Ours and most others count counter-clockwise. MBot's are the raw angles of an RPLidar, which turns clockwise. They
// are recognized by three marks: stamped with the first beam, where ours carry the stamp of the last; a full turn;
// angles that grow with time. (An RPLidar driver that mirrors its angles makes them fall with time, so it is
// counter-clockwise here too.) Confirmed on a log of such a robot against its gyroscope and wheel encoders: scans turn
// against the robot's yaw only when read clockwise. `beam_utimes` and `angles_rad` are of equal length, in the order of
// the message; non-finite angles are passed over. Pure.
[[nodiscard]] AngleSense DetectAngleSense(int64_t utime, std::span<const int64_t> beam_utimes,
                                          std::span<const float> angles_rad);

}  // namespace lcmslam
