#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace lcmslam {

inline constexpr const char* kMainLidarChannel = "LIDAR_2D";
inline constexpr const char* kMultiLineChannel = "LIDAR_3D";
inline constexpr const char* kPacketChannel = "LIDAR_3D_PACKET";
inline constexpr const char* kImuChannel = "IMU";
inline constexpr const char* kOdometryChannel = "ODOMETRY";
inline constexpr const char* kGroundTruthChannel = "GROUND_TRUTH";

// The channel of every sensor of a kind in a log: `main_channel` for the main one, <main_channel>_<NAME> for the others
// ("/front/scan" -> LIDAR_2D_FRONT_SCAN). Main is `chosen`, or when that is "" the one with most messages, the first by
// name among equals. Throws CommandError (kUsage) when `chosen` is none of them.
std::map<std::string, std::string> SensorChannels(const std::map<std::string, int64_t>& messages_by_sensor,
                                                  const std::string& chosen, const std::string& main_channel);

// SensorChannels of planar lidars. Throws CommandError (kBadInput) with the line `why_none` when there are none.
std::map<std::string, std::string> LidarChannels(const std::map<std::string, int64_t>& scans_by_lidar,
                                                 const std::string& chosen, const std::string& why_none);

// Of all lidars together.
int64_t TotalScans(const std::map<std::string, int64_t>& scans_by_lidar);

}  // namespace lcmslam
