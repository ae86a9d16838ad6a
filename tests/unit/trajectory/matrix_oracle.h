#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "geometry/pose3.h"

namespace lcmslam::testing {

// Poses as 4x4 matrices with a general inverse: shares no code with Pose3.
inline Eigen::Matrix4d Matrix(const Pose3& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  Eigen::Matrix4d m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), pose.translation.x(),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), pose.translation.y(),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), pose.translation.z(),   //
      0, 0, 0, 1;
  return m;
}

inline double Translation(const Eigen::Matrix4d& m) { return m.topRightCorner<3, 1>().norm(); }

// From the skew part and the trace, so that small angles keep their digits.
inline double Angle(const Eigen::Matrix4d& m) {
  const Eigen::Vector3d axis(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
  return std::atan2(axis.norm(), m.topLeftCorner<3, 3>().trace() - 1.0);
}

}  // namespace lcmslam::testing
