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

namespace {

// Pose2::Exp, cheap for the small angles of one sweep.
struct Motion {
  double c, s, x, y;

  explicit Motion(const Eigen::Vector3d& twist) {
    const double w = twist.z();
    const double w2 = w * w;
    if (w2 > 0.01) {
      const Pose2 T = Pose2::Exp(twist);
      c = T.cos(), s = T.sin(), x = T.x(), y = T.y();
      return;
    }
    const double a = 1.0 - w2 / 6.0 * (1.0 - w2 / 20.0);               // sin(w) / w
    const double b = w / 2.0 * (1.0 - w2 / 12.0 * (1.0 - w2 / 30.0));  // (1 - cos(w)) / w
    c = 1.0 - w * b, s = w * a;
    x = a * twist.x() - b * twist.y(), y = b * twist.x() + a * twist.y();
  }
  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    return {x + c * p.x() - s * p.y(), y + s * p.x() + c * p.y()};
  }
};

}  // namespace

void Deskew(std::span<const ScanPoint> points, const Eigen::Vector3d& twist_body, std::vector<Eigen::Vector2d>* p_end) {
  p_end->resize(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const double dt_s = points[i].dt_s;
    (*p_end)[i] = dt_s == 0.0 ? points[i].p_body : Motion(twist_body * dt_s) * points[i].p_body;
  }
}

}  // namespace lcmslam
