#include "common/diagnostics.h"

#include <chrono>

#include <lcmslam/slam_diagnostics_t.hpp>

namespace lcmslam {

void SetCovariance(const Eigen::Ref<const Eigen::MatrixXd>& covariance, slam_diagnostics_t& diagnostics) {
  diagnostics.dof = static_cast<int16_t>(covariance.rows());
  diagnostics.num_covariance = static_cast<int16_t>(covariance.size());
  const auto by_row = covariance.transpose().reshaped();
  diagnostics.covariance.assign(by_row.begin(), by_row.end());
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
