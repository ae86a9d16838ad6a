#include "unit/evaluator/circle_run.h"

#include <cmath>

#include <lcmslam/pose_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "trajectory/write.h"

namespace lcmslam::testing {
namespace {

Pose2 Circle(double t_s) { return Pose2(std::cos(0.25 * t_s) * 2.0, std::sin(0.25 * t_s) * 2.0, 0.25 * t_s); }

}  // namespace

Trajectory Reference(double duration_s) {
  Trajectory t;
  for (int k = 0; k * 0.02 <= duration_s; ++k) t.push_back({kStart + k * 20'000, ToPose3(Circle(0.02 * k))});
  return t;
}

Trajectory Estimate(double error_m) {
  Trajectory t;
  for (int k = 0; k <= 400; ++k) {
    const Pose2 error(0.0, k % 2 == 0 ? error_m : -error_m, 0.0);
    t.push_back({kStart + k * 100'000, ToPose3(Pose2(5.0, -3.0, 1.0) * Circle(0.1 * k) * error)});
  }
  return t;
}

TemporaryFile TumFile(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) text += FormatTum(pose);
  return TemporaryFile(text, ".tum");
}

void WriteLog(const std::filesystem::path& path, const Trajectory& estimate, const Trajectory& reference) {
  LogWriter log(path);
  size_t e = 0;
  for (const StampedPose& r : reference) {
    log.Write(r.utime, "GROUND_TRUTH", ToMessage(r));
    for (; e < estimate.size() && estimate[e].utime <= r.utime; ++e) {
      log.Write(r.utime, "SDF2D_POSE", ToMessage(estimate[e]));
    }
  }
  log.Flush();
}

}  // namespace lcmslam::testing
