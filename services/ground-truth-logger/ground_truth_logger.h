#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "bus/log_writer.h"
#include "bus/service.h"
#include "geometry/trajectory.h"

namespace lcmslam {

namespace config {
class GroundTruthLogger;
}

struct GroundTruthLoggerOptions {
  std::string channel = "GROUND_TRUTH|TRUE_POSE";
  double max_gap_s = 5.0;
  std::string prefix = "ground_truth";

  std::string Validate() const;
};

// One stretch of ground truth without a jump in time: a TUM file and an LCM log.
class GroundTruthSegment {
 public:
  // Opens STEM_tum.txt and STEM.lcm; throws CommandError (kRuntime) where that fails.
  explicit GroundTruthSegment(const std::filesystem::path& stem);
  // The event goes to the log as it came.
  void Write(const StampedPose& pose, const Event& event);
  void Flush();
  int64_t last_utime() const { return last_utime_; }

 private:
  std::filesystem::path tum_path_;
  std::ofstream tum_;
  LogWriter log_;
  int64_t last_utime_ = 0;
};

// Records ground truth from the bus. What is older than a second is on disk whatever happens to the process.
class GroundTruthLogger : public Service {
 public:
  using Options = GroundTruthLoggerOptions;
  using Config = config::GroundTruthLogger;
  static constexpr const char* kName = "ground-truth-logger";
  static Options Complete(Config& config);

  GroundTruthLogger(const Options& options, const Config& config, ServiceContext& context);
  void Finish() override;

 private:
  Handled OnPose(const Event& event);
  bool ContinuesSegment(const StampedPose& pose) const;
  void StartSegment();
  void Flush();

  Options options_;
  ServiceContext& context_;
  std::optional<GroundTruthSegment> segment_;
  int segments_ = 0;
  int64_t poses_ = 0;
  int64_t repeated_ = 0;
};

}  // namespace lcmslam
