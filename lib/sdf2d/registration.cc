#include "sdf2d/registration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "sdf2d/sdf_reader.h"

namespace lcmslam::sdf2d {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// sum w a a^T and sum w a phi, with a = d phi / d pose.
struct NormalSums {
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0;

  void Add(double w, double r, double ax, double ay, double at) {
    const double wx = w * ax, wy = w * ay, wt = w * at;
    xx += wx * ax, xy += wx * ay, xt += wx * at, yy += wy * ay, yt += wy * at, tt += wt * at;
    x += wx * r, y += wy * r, t += wt * r;
  }
  Matrix3d Matrix() const { return (Matrix3d() << xx, xy, xt, xy, yy, yt, xt, yt, tt).finished(); }
  Vector3d Vector() const { return {x, y, t}; }
};

// The quadratic model of the scan's cost around a pose.
struct Linearization {
  Matrix3d a_a = Matrix3d::Zero();  // sum w a a^T
  Vector3d a_r = Vector3d::Zero();  // sum w a phi
  double cost = 0.0;                // points without a surface cost as much as the worst inlier
  double inlier_sum_m2 = 0.0;
  double sum_weights = 0.0;
  double sum_lever_m2 = 0.0;
  int matched = 0;
  int inliers = 0;

  // Lets the scan count as `weight` scans.
  void Weigh(double weight) {
    a_a *= weight;
    a_r *= weight;
    for (double* d : {&cost, &sum_weights, &sum_lever_m2}) *d *= weight;
  }
};

struct Problem {
  const SdfMap& map;
  const std::vector<double>& range_variance;
  const std::vector<double>& shared_variance;
  Vector2d origin_body;
  const RegistrationOptions& options;
};

Linearization Linearize(const Problem& problem, const Pose2& T_map_body, std::span<const Vector2d> p_body) {
  const RegistrationOptions& options = problem.options;
  const double min_cos2 = options.min_cos_incidence * options.min_cos_incidence;
  const double map_variance = options.map_sigma_m * options.map_sigma_m;
  const double huber = options.huber_sigmas;
  const double inlier2 = options.inlier_sigmas * options.inlier_sigmas;
  const double cost_cap = huber * (2.0 * options.inlier_sigmas - huber);
  const double c = T_map_body.cos(), s = T_map_body.sin();
  const Vector2d origin_map = T_map_body * problem.origin_body;
  SdfReader reader(problem.map);
  Linearization sum;
  NormalSums sums;
  for (size_t i = 0; i < p_body.size(); ++i) {
    const Vector2d& p = p_body[i];
    const Vector2d p_map = T_map_body * p;
    const Vector2d beam = p_map - origin_map;
    const SdfReader::Sample sample = reader.Facing(p_map, beam);
    if (!sample.IsKnown()) {
      sum.cost += cost_cap;
      continue;
    }
    const Vector2d& g = sample.gradient;
    const double along = g.dot(beam);
    // 1 / (range variance * cos(incidence)^2 + map variance), with one division.
    const double full = g.squaredNorm() * beam.squaredNorm();
    const double own = problem.range_variance[i] * std::max(along * along, min_cos2 * full) + map_variance * full;
    const double precision = full / own;
    const double r = sample.distance_m;
    const double chi2 = r * r * precision;
    double w = full / (own + problem.shared_variance[i] * full);
    if (chi2 > huber * huber) {
      const double sigmas = std::sqrt(chi2);
      w *= huber / sigmas;
      sum.cost += std::min(huber * (2.0 * sigmas - huber), cost_cap);
    } else {
      sum.cost += chi2;
    }
    const double gx = c * g.x() + s * g.y(), gy = c * g.y() - s * g.x();  // in the body frame
    const double gt = p.x() * gy - p.y() * gx;
    sums.Add(w, r, gx, gy, gt);
    sum.sum_weights += w;
    sum.sum_lever_m2 += w * p.squaredNorm();
    ++sum.matched;
    if (chi2 < inlier2) {
      ++sum.inliers;
      sum.inlier_sum_m2 += r * r;
    }
  }
  sum.a_a = sums.Matrix();
  sum.a_r = sums.Vector();
  return sum;
}

// What the errors that n neighbours share add to the variance of each, so that together they weigh as much as one:
// n is the number of beams per shared_length_m of surface.
std::vector<double> SharedVariance(std::span<const ScanPoint> points, const RegistrationOptions& options) {
  const double variance = options.shared_sigma_m * options.shared_sigma_m;
  std::vector<double> shared(points.size(), variance);
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const double spacing_m = std::sqrt(std::min((points[i].p_body - points[i - 1].p_body).squaredNorm(),
                                                (points[i + 1].p_body - points[i].p_body).squaredNorm()));
    if (spacing_m < options.shared_length_m) shared[i] = variance * options.shared_length_m / (spacing_m + 1e-3);
  }
  return shared;
}

// The projector onto pose directions that fewer than min_eigenvalue of the beams (by weight) constrain. Rotation is
// measured by the arc at the beams' rms distance, so that all three directions compare.
Matrix3d Unobservable(const Linearization& scan, double min_eigenvalue) {
  const double lever_m = std::sqrt(scan.sum_lever_m2 / scan.sum_weights) + 1e-9;
  const Vector3d scale(1.0, 1.0, lever_m);
  const Matrix3d to_arc = scale.cwiseInverse().asDiagonal();
  const Matrix3d normalized = to_arc * scan.a_a * to_arc / scan.sum_weights;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(normalized);
  Matrix3d projector = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (eigen.eigenvalues()[i] >= min_eigenvalue) continue;
    projector += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose();
  }
  return to_arc * projector * scale.asDiagonal();
}

}  // namespace

std::array<bool, 3> AlignResult::UnobservableAxes() const {
  const double c = state.T_map_body.cos(), s = state.T_map_body.sin();
  const double along_x = Vector2d(c, -s).dot(unobservable.topLeftCorner<2, 2>() * Vector2d(c, -s));
  const double along_y = Vector2d(s, c).dot(unobservable.topLeftCorner<2, 2>() * Vector2d(s, c));
  return {along_x > 0.5, along_y > 0.5, unobservable(2, 2) > 0.5};
}

AlignResult Align(const SdfMap& map, std::span<const ScanPoint> points, const Vector2d& origin_body,
                  const NoiseModel& noise, const MotionState& prediction, const RegistrationOptions& options) {
  std::vector<double> range_variance(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const double sigma = noise.Sigma(points[i].range_m);
    range_variance[i] = sigma * sigma;
  }
  const std::vector<double> shared_variance = SharedVariance(points, options);
  const Problem problem{map, range_variance, shared_variance, origin_body, options};
  const Matrix6d prior = prediction.covariance.ldlt().solve(Matrix6d::Identity());

  AlignResult result;
  result.points = static_cast<int>(points.size());
  result.state = prediction;
  std::vector<Vector2d> p_body;
  Deskew(points, prediction.twist_body, &p_body);
  Vector6d offset = Vector6d::Zero();  // from the prediction
  Linearization best;
  Vector6d best_offset = offset;
  double best_cost = std::numeric_limits<double>::infinity();
  double damping = 0.0;
  Matrix6d H = prior;
  const auto state_at = [&](const Vector6d& e) {
    return MotionState{prediction.T_map_body * Pose2::Exp(e.head<3>()), prediction.twist_body + e.tail<3>(), {}};
  };

  for (result.iterations = 0; result.iterations < options.max_iterations; ++result.iterations) {
    const MotionState state = state_at(offset);
    Linearization scan = Linearize(problem, state.T_map_body, p_body);
    scan.Weigh(options.independence);
    const double cost = scan.cost + offset.dot(prior * offset);
    if (cost > best_cost * (1.0 + 1e-9)) {  // worse: shorter steps from the best state so far
      damping = std::max(10.0 * damping, 1e-2);
      if (damping > 1e3) break;
    } else {
      if (scan.matched < options.min_points) break;
      best = scan;
      best_cost = cost;
      best_offset = offset;
      damping *= 0.1;
    }
    H = prior;
    H.topLeftCorner<3, 3>() += best.a_a;
    Vector6d gradient = prior * best_offset;
    gradient.head<3>() += best.a_r;
    Matrix6d damped = H;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d step = -damped.ldlt().solve(gradient);
    offset = best_offset + step;
    if (step.dot(H * step) < options.stop_sigmas * options.stop_sigmas) {
      result.status = AlignStatus::kConverged;
      best_offset = offset;
      ++result.iterations;
      break;
    }
  }
  if (best.matched < options.min_points) return result;
  if (result.status != AlignStatus::kConverged) result.status = AlignStatus::kIterationLimit;
  result.state = state_at(best_offset);
  result.state.covariance = H.ldlt().solve(Matrix6d::Identity());
  result.information = best.a_a;
  result.unobservable = Unobservable(best, options.min_eigenvalue);
  result.matched = best.matched;
  result.inliers = best.inliers;
  result.residual_rms_m = best.inliers > 0 ? std::sqrt(best.inlier_sum_m2 / best.inliers) : 0.0;
  return result;
}

}  // namespace lcmslam::sdf2d
