#pragma once

#include <span>

#include <Eigen/Core>

namespace lcmslam {

class slam_diagnostics_t;

// Square: x, y, yaw or translation, rotation; map axes.
void SetCovariance(const Eigen::Ref<const Eigen::MatrixXd>& covariance, slam_diagnostics_t& diagnostics);

// As many names as times.
void SetStages(std::span<const char* const> names, std::span<const double> ms, slam_diagnostics_t& diagnostics);

// A stopwatch for the stages of a pipeline.
double MonotonicMs();

}  // namespace lcmslam
