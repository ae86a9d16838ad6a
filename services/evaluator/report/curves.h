#pragma once

#include <map>
#include <string>
#include <vector>

#include "evaluator/report/study.h"
#include "geometry/trajectory.h"

namespace lcmslam::report {

// What one system did in one episode, in the reference's frame, aligned as its metrics say.
struct SystemCurve {
  Trajectory trajectory;
  std::vector<double> time_s;   // of each matched pose, from the start of the reference
  std::vector<double> error_m;  // of each matched pose
};

struct EpisodeCurves {
  Trajectory reference;  // empty where the episode has none
  std::map<std::string, SystemCurve> systems;
};

// Throws CommandError (kBadInput) for a trajectory file that cannot be read.
EpisodeCurves LoadCurves(const Episode& episode);

}  // namespace lcmslam::report
