#include "sdf2d/surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace lcmslam::sdf2d {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// One return seen from the lidar.
struct Ray {
  Vector2d direction;
  double range_m;
  double sigma_m;
};

// Sums over beams 0..i-1, so that any run's fit costs the same.
struct Sums {
  double cc = 0, cs = 0, ss = 0, cu = 0, su = 0, uu = 0;
  Sums operator-(const Sums& o) const { return {cc - o.cc, cs - o.cs, ss - o.ss, cu - o.cu, su - o.su, uu - o.uu}; }
};

class Splitter {
 public:
  Splitter(std::span<const Ray> rays, const SurfaceOptions& options) : rays_(rays), options_(options) {
    prefix_.resize(rays.size() + 1);
    for (size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i];
      const double u = 1.0 / ray.range_m;
      const double w = 1.0 / (u * u * u * u * ray.sigma_m * ray.sigma_m);
      const double c = ray.direction.x(), s = ray.direction.y();
      const Sums& last = prefix_[i];
      prefix_[i + 1] = {last.cc + w * c * c, last.cs + w * c * s, last.ss + w * s * s,
                        last.cu + w * c * u, last.su + w * s * u, last.uu + w * u * u};
    }
  }

  // Runs [begin, end) of beams that lie on one line each.
  std::vector<std::pair<int, int>> Split() {
    const int n = static_cast<int>(rays_.size());
    int begin = 0;
    for (int i = 1; i <= n; ++i) {
      if (i < n && !IsGap(i)) continue;
      SplitRun(begin, i, Chi2(begin, i));
      begin = i;
    }
    return std::move(runs_);
  }

 private:
  Vector2d EndPoint(int i) const { return rays_[i].range_m * rays_[i].direction; }

  bool IsGap(int i) const { return (EndPoint(i) - EndPoint(i - 1)).norm() > options_.max_gap_m; }

  double Chi2(int begin, int end) const {
    if (end - begin <= 2) return 0.0;
    const Sums s = prefix_[end] - prefix_[begin];
    const double determinant = s.cc * s.ss - s.cs * s.cs;
    if (!(determinant > 1e-14 * s.cc * s.ss)) return 0.0;
    const double explained = (s.ss * s.cu * s.cu - 2.0 * s.cs * s.cu * s.su + s.cc * s.su * s.su) / determinant;
    return std::max(0.0, s.uu - explained);
  }

  void SplitRun(int begin, int end, double chi2) {
    if (chi2 > options_.split_chi2) {
      int best = begin;
      double best_chi2 = chi2;
      const auto consider = [&](int middle) {
        const double parts = Chi2(begin, middle) + Chi2(middle, end);
        if (parts < best_chi2) {
          best_chi2 = parts;
          best = middle;
        }
      };
      const int stride = end - begin > 32 ? 4 : 1;
      for (int middle = begin + 1; middle < end; middle += stride) consider(middle);
      for (int middle = std::max(begin + 1, best - 3), last = std::min(end - 1, best + 3); stride > 1 && middle <= last;
           ++middle)
        consider(middle);
      if (chi2 - best_chi2 > options_.split_chi2) {
        SplitRun(begin, best, Chi2(begin, best));
        SplitRun(best, end, Chi2(best, end));
        return;
      }
    }
    AddRun(begin, end);
  }

  // Cut into pieces that are short enough.
  void AddRun(int begin, int end) {
    if (options_.max_piece_m > 0.0) {
      for (int i = begin + 1; i < end; ++i) {
        if ((EndPoint(i) - EndPoint(begin)).norm() <= options_.max_piece_m) continue;
        runs_.emplace_back(begin, i);
        begin = i;
      }
    }
    runs_.emplace_back(begin, end);
  }

  std::span<const Ray> rays_;
  const SurfaceOptions& options_;
  std::vector<Sums> prefix_;
  std::vector<std::pair<int, int>> runs_;
};

// Maximum likelihood line through the rays: Gauss-Newton on range residuals r_i - 1 / (m.u_i).
bool FitLine(std::span<const Ray> rays, const Vector2d& origin, double min_cos, SurfaceLine* line) {
  Vector2d m = Vector2d::Zero();
  Matrix2d covariance;
  for (int round = 0; round < 3; ++round) {
    Matrix2d H = Matrix2d::Zero();
    Vector2d b = Vector2d::Zero();
    for (const Ray& ray : rays) {
      const double u = round == 0 ? 1.0 / ray.range_m : m.dot(ray.direction);
      if (!(u > 0.0)) return false;
      const double w = 1.0 / (u * u * u * u * ray.sigma_m * ray.sigma_m);
      // The inverse range measured, linearized on the current line.
      const double measured = round == 0 ? u : u * (2.0 - ray.range_m * u);
      H += w * ray.direction * ray.direction.transpose();
      b += w * measured * ray.direction;
    }
    const double determinant = H.determinant();
    if (!(determinant > 1e-12 * H(0, 0) * H(1, 1))) return false;
    covariance = H.inverse();
    m = covariance * b;
  }
  const double length = m.norm();
  const double u_begin = m.dot(rays.front().direction);
  const double u_end = m.dot(rays.back().direction);
  if (!(u_begin > min_cos * length && u_end > min_cos * length)) return false;

  const Vector2d begin = rays.front().direction / u_begin;  // from the lidar
  const Vector2d end = rays.back().direction / u_end;
  const double extent = (end - begin).norm();
  const Vector2d along = extent > 0.0 ? Vector2d((end - begin) / extent) : Vector2d::Zero();
  // The offset's derivative by m at a point f of the line is -f / |m|.
  const Matrix2d C = covariance / (length * length);
  line->variance = {begin.dot(C * begin), 2.0 * begin.dot(C * along), along.dot(C * along)};
  line->normal = -m / length;
  line->begin = origin + begin;
  line->end = origin + end;
  line->num_beams = static_cast<int>(rays.size());
  const Ray& middle = rays[rays.size() / 2];
  line->beam_sigma_m = middle.sigma_m * m.dot(middle.direction) / length;
  return true;
}

}  // namespace

std::vector<SurfaceLine> ExtractSurface(std::span<const Vector2d> p_body, const Vector2d& origin_body,
                                        const NoiseModel& noise, const SurfaceOptions& options) {
  std::vector<Ray> rays;
  rays.reserve(p_body.size());
  for (const Vector2d& p : p_body) {
    const Vector2d beam = p - origin_body;
    const double range_m = beam.norm();
    if (!(range_m > 0.0)) continue;
    rays.push_back({beam / range_m, range_m, noise.Sigma(range_m)});
  }
  std::vector<SurfaceLine> lines;
  for (const auto& [begin, end] : Splitter(rays, options).Split()) {
    SurfaceLine line;
    if (end - begin < options.min_beams) continue;
    const std::span<const Ray> run = std::span(rays).subspan(begin, end - begin);
    if (FitLine(run, origin_body, std::cos(options.max_incidence_rad), &line)) lines.push_back(line);
  }
  return lines;
}

}  // namespace lcmslam::sdf2d
