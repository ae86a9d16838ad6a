#pragma once

#include <Eigen/Core>

#include "octo3d/motion.h"

namespace lcmslam::octo3d {

// Unit vectors (translation m, rotation rad).
using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// What a sweep does not show, least known first. information: of a pose (translation, rotation); noise: how much of it
// is known to be none. Rotations are first scaled by the lever arm at which they weigh as much as translations, so that
// the eigenvalues compare; unobservable are directions where what is left has less than min_share of the information's
// trace of their kind.
Directions UnobservableDirections(const Matrix6& information, double min_share, const Matrix6& noise = Matrix6::Zero());

}  // namespace lcmslam::octo3d
