#include "evaluator/pose_sources.h"

#include <future>
#include <map>
#include <regex>

#include <fmt/format.h>

#include "bus/errors.h"
#include "bus/lcm_log.h"
#include "bus/log_reader.h"
#include "bus/messages.h"
#include "bus/progress.h"
#include "geometry/utime.h"

namespace lcmslam {
namespace {

constexpr int64_t kSecondUs = 1'000'000;

std::regex CompilePattern(const std::string& pattern) {
  try {
    return std::regex(pattern, std::regex::extended);
  } catch (const std::regex_error&) {
    throw CommandError(ExitCode::kUsage, fmt::format("channel '{}': not a regular expression", pattern));
  }
}

// The poses of the channels that match one pattern.
class ChannelPoses {
 public:
  ChannelPoses(const std::filesystem::path& log, const std::string& pattern)
      : log_(log), pattern_(pattern), regex_(CompilePattern(pattern)) {}

  void Add(const Event& event) {
    if (!std::regex_match(event.channel, regex_)) return;
    PoseSource& source = by_channel_[event.channel];
    const auto pose = DecodePose(event.data);
    if (!pose || !IsReasonableUtime(pose->utime)) {
      ++source.refused;
      return;
    }
    Trajectory& trajectory = source.trajectory;
    const int64_t step_us = trajectory.empty() ? 1 : pose->utime - trajectory.back().utime;
    if (step_us < -kSecondUs) {
      throw CommandError(
          ExitCode::kBadInput,
          fmt::format("{}: {}: the clock steps back by {:.3f} s after pose {}; cut the log there", log_.string(),
                      event.channel, static_cast<double>(-step_us) * 1e-6, trajectory.size()));
    }
    if (step_us > 0) trajectory.push_back(*pose);
    if (step_us <= 0) ++source.out_of_order;
  }

  PoseSource Take() {
    int64_t refused = 0;
    std::erase_if(by_channel_, [&](const auto& entry) {
      const bool is_empty = entry.second.trajectory.empty();
      if (is_empty) refused += entry.second.refused;
      return is_empty;
    });
    if (by_channel_.empty()) {
      const std::string why = refused == 0 ? "" : fmt::format(": {} malformed", refused);
      throw CommandError(ExitCode::kNothingMatched, fmt::format("{}: no poses on {}{}", log_.string(), pattern_, why));
    }
    auto& [channel, source] = *by_channel_.begin();
    if (by_channel_.size() > 1) {
      throw CommandError(ExitCode::kUsage, fmt::format("{}: '{}' matches {} and {}", log_.string(), pattern_, channel,
                                                       std::next(by_channel_.begin())->first));
    }
    source.channel = channel;
    source.name = fmt::format("{} in {}", channel, log_.string());
    return std::move(source);
  }

 private:
  std::filesystem::path log_;
  std::string pattern_;
  std::regex regex_;
  std::map<std::string, PoseSource> by_channel_;
};

}  // namespace

bool NamesFile(const std::string& name) {
  static const std::regex has_slash_or_extension(".*/.*|.*\\.[A-Za-z0-9]+");
  std::error_code missing;
  return std::filesystem::is_regular_file(name, missing) || std::regex_match(name, has_slash_or_extension);
}

PoseSource ReadPoseFile(const std::filesystem::path& path, const ReadOptions& options) {
  TrajectoryFile file = ReadTrajectory(path, options);
  if (!file.error.empty() && BeginsAsLcmLog(path))
    file.error =
        path.string() + ": an LCM log, no trajectory file: evaluate it with --log-in, convert it with --channel";
  if (!file.error.empty()) throw CommandError(ExitCode::kBadInput, file.error);
  return {.name = path.string(), .channel = "", .trajectory = std::move(file.trajectory)};
}

PoseSources ReadPoseFiles(const std::filesystem::path& estimate, const std::filesystem::path& reference,
                          const ReadOptions& options) {
  auto other = std::async(std::launch::async, [&] { return ReadPoseFile(reference, options); });
  PoseSource first = ReadPoseFile(estimate, options);
  return {std::move(first), other.get()};
}

PoseSources ReadPoseChannels(const std::filesystem::path& log, const std::string& estimate_pattern,
                             const std::string& reference_pattern, bool quiet) {
  LogReader reader(log);
  Progress progress(reader.size_bytes(), quiet);
  ChannelPoses estimate(log, estimate_pattern), reference(log, reference_pattern);
  PoseSources sources;
  for (Event event; reader.Next(event);) {
    sources.timing.Add(event);
    estimate.Add(event);
    reference.Add(event);
    progress.Show(reader.position_bytes());
  }
  if (reader.damaged_bytes() > 0) sources.log_damage = reader.DamageReport();
  if (!estimate_pattern.empty()) sources.estimate = estimate.Take();
  if (!reference_pattern.empty()) sources.reference = reference.Take();
  return sources;
}

std::vector<Relation> ReadRelationFile(const std::filesystem::path& path) {
  RelationFile file = ReadRelations(path);
  if (!file.error.empty()) throw CommandError(ExitCode::kBadInput, file.error);
  return std::move(file.relations);
}

}  // namespace lcmslam
