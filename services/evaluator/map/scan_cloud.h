#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lcmslam {

// Where the returns of a log's planar lidar ended, in the frame of the poses on `pose_channel` (a regular expression
// for one channel), m. Each beam is placed by the poses at its own time (linear + SLERP), so the log tells poses often
// enough for that; beams at times without poses, or in gaps of more than 0.3 s, are left out. Throws CommandError as
// ReadPoseChannels does; kNothingMatched where no beam can be placed.
[[nodiscard]] std::vector<Eigen::Vector2d> ReadScanCloud(const std::filesystem::path& log,
                                                         const std::string& pose_channel, bool quiet);

}  // namespace lcmslam
