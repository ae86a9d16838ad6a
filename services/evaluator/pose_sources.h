#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "evaluator/timing.h"
#include "trajectory/read.h"
#include "trajectory/relations.h"

namespace lcmslam {

// A trajectory and where it came from.
struct PoseSource {
  std::string name;          // file, or "CHANNEL in LOG"
  std::string channel = {};  // "" for a file
  Trajectory trajectory;
  int64_t refused = 0;       // malformed messages
  int64_t out_of_order = 0;  // poses left out because their stamp repeats or steps back by up to a second
};

// Whether `name` means a file and not a channel: one that exists, or a name with a slash or an extension.
bool NamesFile(const std::string& name);

// All throw CommandError. kBadInput: a file or log that cannot be read or is malformed, with its line; a clock that
// steps back by more than a second in a log. kNothingMatched: a channel without poses. kUsage: several such channels.
PoseSource ReadPoseFile(const std::filesystem::path& path, const ReadOptions& options);
struct PoseSources {
  PoseSource estimate, reference;
  TimingCollector timing = {};
  std::string log_damage = {};  // "" or what is wrong with the log
};
// Two files, read at the same time.
PoseSources ReadPoseFiles(const std::filesystem::path& estimate, const std::filesystem::path& reference,
                          const ReadOptions& options);
// The patterns are regular expressions for one channel each; poses are recognized by fingerprint. An empty pattern
// reads nothing.
PoseSources ReadPoseChannels(const std::filesystem::path& log, const std::string& estimate_pattern,
                             const std::string& reference_pattern, bool quiet);
std::vector<Relation> ReadRelationFile(const std::filesystem::path& path);

}  // namespace lcmslam
