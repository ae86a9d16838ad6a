#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "geometry/trajectory.h"

namespace lcmslam {

// One pose a line; stamps exact to the microsecond, all numbers with nine decimals. Each returns "" or "FILE: reason".
// `timestamp tx ty tz qx qy qz qw`, s and m. FormatTum is one such line, with its newline.
[[nodiscard]] std::string FormatTum(const StampedPose& pose);
[[nodiscard]] std::string WriteTum(const std::filesystem::path& path, std::span<const StampedPose> trajectory);
// `#timestamp [ns],p_x [m],...,q_w,q_x,q_y,q_z`.
[[nodiscard]] std::string WriteEuroc(const std::filesystem::path& path, std::span<const StampedPose> trajectory);
// Row-major 3x4 matrices; the stamps go to `times`, in s, unless that is empty.
[[nodiscard]] std::string WriteKitti(const std::filesystem::path& path, std::span<const StampedPose> trajectory,
                                     const std::filesystem::path& times = {});

}  // namespace lcmslam
