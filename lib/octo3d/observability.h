#pragma once

#include <Eigen/Core>

#include "octo3d/motion.h"

namespace lcmslam::octo3d {

// Unit vectors (translation m, rotation rad).
using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// What a sweep does not show, least known first. information: of a pose (translation, rotation). Rotations are first
// scaled by the lever arm at which they weigh as much as translations, so that the eigenvalues compare; unobservable
// are directions with less than min_share of the trace of their kind.
Directions UnobservableDirections(const Matrix6& information, double min_share);

}  // namespace lcmslam::octo3d
