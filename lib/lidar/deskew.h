#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose2.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

// Where a beam ended, in the body frame at the beam's own time.
struct ScanPoint {
  Eigen::Vector2d p_body = Eigen::Vector2d::Zero();  // m
  double range_m = 0.0;
  double dt_s = 0.0;  // beam time minus scan utime
};

// The returns within [min_range_m, max_range_m], in beam order; beams with a non-finite angle are dropped.
[[nodiscard]] std::vector<ScanPoint> ReturnsInBody(const PlanarScan& scan, const Pose2& T_body_lidar,
                                                   double min_range_m, double max_range_m);

// The points in the body frame at the scan's utime, if the body moved with a constant twist (vx, vy, yaw rate; m/s,
// rad/s; body frame) during the scan: p_end = Exp(twist dt) p_body(dt).
void Deskew(std::span<const ScanPoint> points, const Eigen::Vector3d& twist_body, std::vector<Eigen::Vector2d>* p_end);

}  // namespace lcmslam
