#include "baselines/cloud3d_cloud.h"

namespace lcmslam::cloud3d {

Cloud Transformed(const Pose3& T_a_b, Cloud cloud_b) {
  const Eigen::Matrix3f R_a_b = T_a_b.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f t_a_b = T_a_b.translation.cast<float>();
  for (Eigen::Vector3f& p : cloud_b.points) p = R_a_b * p + t_a_b;
  for (Eigen::Vector3f& n : cloud_b.normals) n = R_a_b * n;
  return cloud_b;
}

}  // namespace lcmslam::cloud3d
