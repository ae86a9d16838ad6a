#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace lcmslam {

inline constexpr const char* kMainLidarChannel = "LIDAR_2D";
inline constexpr const char* kMultiLineChannel = "LIDAR_3D";
inline constexpr const char* kImuChannel = "IMU";
inline constexpr const char* kOdometryChannel = "ODOMETRY";
inline constexpr const char* kGroundTruthChannel = "GROUND_TRUTH";

// The channel of every lidar of a log: LIDAR_2D for the main one, LIDAR_2D_<NAME> for the others ("/front/scan" ->
// LIDAR_2D_FRONT_SCAN). Main is `chosen`, or when that is "" the one with most scans, the first by name among equals.
// Throws CommandError: kUsage when `chosen` is none of them; kBadInput with the line `why_none` when there are no
// lidars.
std::map<std::string, std::string> LidarChannels(const std::map<std::string, int64_t>& scans_by_lidar,
                                                 const std::string& chosen, const std::string& why_none);

// Of all lidars together.
int64_t TotalScans(const std::map<std::string, int64_t>& scans_by_lidar);

}  // namespace lcmslam
