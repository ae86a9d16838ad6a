#include "lidar/deskew.h"

#include <cmath>

namespace lcmslam {

std::vector<ScanPoint> ReturnsInBody(const PlanarScan& scan, const Pose2& T_body_lidar, double min_range_m,
                                     double max_range_m) {
  std::vector<ScanPoint> points;
  points.reserve(scan.beams.size());
  for (const Beam& beam : scan.beams) {
    const double range_m = beam.range_m;
    const double angle_rad = beam.angle_rad;
    if (!beam.HasReturn() || range_m < min_range_m || range_m > max_range_m || !std::isfinite(angle_rad)) continue;
    const Eigen::Vector2d p_lidar(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    points.push_back({T_body_lidar * p_lidar, range_m, 1e-6 * beam.dt_us});
  }
  return points;
}

void Deskew(std::span<const ScanPoint> points, const Eigen::Vector3d& twist_body, std::vector<Eigen::Vector2d>* p_end) {
  p_end->resize(points.size());
  double dt_s = 0.0;
  Pose2 T_end_beam;  // of the last distinct time
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].dt_s != dt_s) {
      dt_s = points[i].dt_s;
      T_end_beam = Pose2::Exp(twist_body * dt_s);
    }
    (*p_end)[i] = T_end_beam * points[i].p_body;
  }
}

}  // namespace lcmslam
