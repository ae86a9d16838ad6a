#pragma once

#include <filesystem>

#include "geometry/trajectory.h"
#include "support/temporary_file.h"

namespace lcmslam::testing {

inline constexpr int64_t kStart = 1'600'000'000'000'000;

// A circle at 0.5 m/s. The estimate is in a frame of its own and `error_m` too far out on every second pose.
Trajectory Reference(double duration_s = 40.0);
Trajectory Estimate(double error_m);

TemporaryFile TumFile(const Trajectory& trajectory);
// A log with GROUND_TRUTH and SDF2D_POSE, as they would come in live: by time.
void WriteLog(const std::filesystem::path& path, const Trajectory& estimate, const Trajectory& reference);

}  // namespace lcmslam::testing
