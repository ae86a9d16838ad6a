#pragma once

#include <map>
#include <string>
#include <vector>

#include "bus/log_reader.h"

namespace lcmslam {

namespace result {
class Timing;
}

// What a system and its service said of their own speed, on ..._DIAGNOSTICS and ..._STATUS. Nothing where it is all 0,
// as in reproducible log-to-log runs.
class TimingCollector {
 public:
  void Add(const Event& event);
  // Of the system that publishes on `pose_channel`: SDF2D_POSE belongs to SDF2D_DIAGNOSTICS and SDF2D_SLAM_STATUS.
  // False when nothing is known.
  bool Report(const std::string& pose_channel, result::Timing& message) const;

 private:
  struct System {
    std::vector<double> step_ms;                           // all stages of one scan
    std::vector<double> iterations;                        // of the registration of one scan
    std::map<std::string, std::vector<double>> stages_ms;  // by name of the stage
    std::vector<double> latency_p50_ms, latency_p99_ms;    // of one second each
  };
  std::map<std::string, System> systems_;  // by prefix of the channels
};

}  // namespace lcmslam
