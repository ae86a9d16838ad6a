#include "common/planar_diagnostics.h"

#include <chrono>

#include <lcmslam/slam_diagnostics_t.hpp>

namespace lcmslam {

void SetCovariance(const Eigen::Matrix3d& covariance, slam_diagnostics_t& diagnostics) {
  diagnostics.dof = 3;
  diagnostics.num_covariance = 9;
  diagnostics.covariance.assign(covariance.data(), covariance.data() + 9);
}

void SetStages(std::span<const char* const> names, std::span<const double> ms, slam_diagnostics_t& diagnostics) {
  diagnostics.num_stages = static_cast<int16_t>(names.size());
  diagnostics.stage_name.assign(names.begin(), names.end());
  diagnostics.stage_ms.assign(ms.begin(), ms.end());
}

double MonotonicMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace lcmslam
