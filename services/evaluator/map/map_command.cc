#include "evaluator/map/map_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "evaluator/files.h"
#include "evaluator/map/mapped_surface.h"
#include "evaluator/map/scan_cloud.h"
#include "evaluator/result.h"
#include "geometry/pose3.h"
#include "trajectory/map_quality.h"

namespace lcmslam {
namespace {

struct Arguments {
  std::filesystem::path map, truth, metrics;
  std::string truth_channel = "GROUND_TRUTH";
  std::filesystem::path log;
  std::string estimate = "SDF2D_POSE";
  std::filesystem::path json;
  bool quiet = false;
};

// From the map's frame into the world, as the evaluation of its trajectory found it.
Pose3 ReadAlignment(const std::filesystem::path& metrics) {
  if (metrics.empty()) return {};
  result::Evaluation evaluation;
  ReadJson(metrics, evaluation);
  if (!evaluation.has_alignment()) {
    throw CommandError(ExitCode::kBadInput, fmt::format("{}: no alignment in it", metrics.string()));
  }
  return ToPose(evaluation.alignment().t_world_map());
}

void CompareWithTruth(const Arguments& arguments, result::MapQuality& message) {
  std::vector<Eigen::Vector3d> mapped = ReadMappedSurface(arguments.map), truth;
  const Pose3 T_world_map = ReadAlignment(arguments.metrics);
  for (Eigen::Vector3d& p : mapped) p = T_world_map * p;
  for (const Eigen::Vector2d& p : ReadScanCloud(arguments.truth, arguments.truth_channel, arguments.quiet)) {
    truth.emplace_back(p.x(), p.y(), 0.0);
  }
  const SurfaceQuality quality = CompareSurfaces(mapped, truth);
  message.set_map(arguments.map.string());
  message.set_truth(arguments.truth.string());
  *message.mutable_surface_error_m() = ToMessage(quality.distance_m);
  for (const Completeness& completeness : quality.completeness) {
    result::MapQuality::Completeness& share = *message.add_completeness();
    share.set_within_m(completeness.within_m);
    share.set_share(completeness.share);
  }
}

void MeasureWalls(const Arguments& arguments, result::MapQuality& message) {
  message.set_scans(fmt::format("{} in {}", arguments.estimate, arguments.log.string()));
  *message.mutable_wall_thickness_m() =
      ToMessage(WallThickness(ReadScanCloud(arguments.log, arguments.estimate, arguments.quiet)));
}

void Print(const result::MapQuality& m) {
  if (m.has_surface_error_m()) {
    const result::Summary& error = m.surface_error_m();
    fmt::print("mapped surface to true surface: mean {:.2f} mm, p95 {:.2f} mm, max {:.2f} mm ({} points)\n",
               1e3 * error.mean(), 1e3 * error.p95(), 1e3 * error.max(), error.count());
    for (const auto& share : m.completeness()) {
      fmt::print("true surface mapped within {:g} cm: {:.2f} %\n", 100.0 * share.within_m(), 100.0 * share.share());
    }
  }
  if (m.has_wall_thickness_m()) {
    const result::Summary& walls = m.wall_thickness_m();
    fmt::print("wall thickness (SD): median {:.2f} mm, mean {:.2f} mm, p95 {:.2f} mm ({} squares of 0.5 m)\n",
               1e3 * walls.median(), 1e3 * walls.mean(), 1e3 * walls.p95(), walls.count());
  }
}

ExitCode JudgeMap(const Arguments& arguments, const std::string& typed) {
  if (arguments.map.empty() == arguments.log.empty()) {
    throw CommandError(ExitCode::kUsage, "either --map FILE with --truth LOG, or --log-in LOG");
  }
  if (!arguments.map.empty() && arguments.truth.empty()) throw CommandError(ExitCode::kUsage, "--truth LOG: required");
  result::MapQuality message;
  message.set_command(typed);
  arguments.map.empty() ? MeasureWalls(arguments, message) : CompareWithTruth(arguments, message);
  Print(message);
  if (!arguments.json.empty()) WriteFile(arguments.json, ToJson(message));
  return ExitCode::kOk;
}

}  // namespace

void AddMapCommand(CLI::App& app, const std::string& typed, std::function<ExitCode()>& command) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& map = *app.add_subcommand("map", "How good a map is: by the true surface, or by how thick its walls are");
  map.add_option("--map", arguments->map, "what is judged: .sdf, .yaml (ROS map_server) or .ply");
  map.add_option("--truth", arguments->truth, "log of the same episode without noise and motion distortion");
  map.add_option("--truth-channel", arguments->truth_channel, "true poses in it");
  map.add_option("--metrics", arguments->metrics, "evaluation of the trajectory, whose alignment the map takes");
  map.add_option("--log-in", arguments->log, "log whose scans are drawn by its estimate: wall thickness");
  map.add_option("--estimate", arguments->estimate, "channel of that estimate");
  map.add_option("--json", arguments->json, "write the result to this file");
  map.add_flag("--quiet", arguments->quiet, "no progress bar");
  map.callback([arguments, typed, &command] { command = [arguments, typed] { return JudgeMap(*arguments, typed); }; });
}

}  // namespace lcmslam
