#pragma once

#include <Eigen/Core>

#include "octo3d/motion.h"

namespace lcmslam::octo3d {

struct Observability {
  Eigen::Matrix<double, 6, Eigen::Dynamic> held{6, 0};  // unit vectors (translation m, rotation rad), most held first
  Matrix6 projection = Matrix6::Identity();             // P H P^T, P b: information without the held directions
};

// information: of a pose (translation, rotation). Rotations are first scaled by the lever arm at which they weigh as
// much as translations, so that the eigenvalues compare; directions with less than min_share of the trace of their kind
// are held.
Observability FindUnobservable(const Matrix6& information, double min_share);

}  // namespace lcmslam::octo3d
