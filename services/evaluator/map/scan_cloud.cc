#include "evaluator/map/scan_cloud.h"

#include <cmath>

#include <fmt/format.h>

#include "bus/errors.h"
#include "common/scan_input.h"
#include "evaluator/pose_sources.h"

namespace lcmslam {
namespace {

struct Scans {
  std::vector<PlanarScan> scans;
  Pose2 T_body_lidar;
};

Scans ReadScans(const std::filesystem::path& log) {
  Scans result;
  ScanInput input(
      "", /*mounting_configured=*/false, [&](const Pose2& T_body_lidar) { result.T_body_lidar = T_body_lidar; },
      [&](const PlanarScan& scan) { result.scans.push_back(scan); });
  LogReader reader(log);
  for (Event event; reader.Next(event);) input.Offer(event);
  input.Flush();
  return result;
}

}  // namespace

std::vector<Eigen::Vector2d> ReadScanCloud(const std::filesystem::path& log, const std::string& pose_channel,
                                           bool quiet) {
  constexpr int64_t kMaxGap_us = 300'000;
  const Trajectory poses = ReadPoseChannels(log, pose_channel, "", quiet).estimate.trajectory;
  const Scans input = ReadScans(log);
  std::vector<Eigen::Vector2d> points;
  for (const PlanarScan& scan : input.scans) {
    for (const Beam& beam : scan.beams) {
      if (!beam.HasReturn() || !std::isfinite(beam.angle_rad)) continue;
      const auto T_map_body = InterpolateAt(poses, scan.utime + beam.dt_us, kMaxGap_us);
      if (!T_map_body) continue;
      const Eigen::Vector2d p_lidar(beam.range_m * std::cos(beam.angle_rad), beam.range_m * std::sin(beam.angle_rad));
      points.push_back(ToPose2(*T_map_body) * (input.T_body_lidar * p_lidar));
    }
  }
  if (points.empty()) {
    throw CommandError(ExitCode::kNothingMatched,
                       fmt::format("{}: no scan can be placed by the poses on {}", log.string(), pose_channel));
  }
  return points;
}

}  // namespace lcmslam
