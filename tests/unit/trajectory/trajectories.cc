#include "unit/trajectory/trajectories.h"

#include <cmath>
#include <numbers>

namespace lcmslam::testing {

double Noise::Uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

double Noise::Gauss(double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform(0.0, 1.0)));
  return sigma * radius * std::cos(2.0 * std::numbers::pi * Uniform(0.0, 1.0));
}

Eigen::Quaterniond RotationVector(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_rad / angle));
}

Pose3 RandomPose(Noise& noise, double size_m) {
  const Eigen::Vector3d translation(noise.Uniform(-size_m, size_m), noise.Uniform(-size_m, size_m),
                                    noise.Uniform(-size_m, size_m));
  return {translation, RotationVector({noise.Uniform(-2, 2), noise.Uniform(-2, 2), noise.Uniform(-2, 2)})};
}

Trajectory Sample(const std::function<Pose3(double)>& motion, double duration_s, double period_s, int64_t start_utime) {
  Trajectory trajectory;
  for (int k = 0; k * period_s <= duration_s; ++k) {
    trajectory.push_back({start_utime + std::llround(k * period_s * 1e6), motion(k * period_s)});
  }
  return trajectory;
}

Pose3 Drive(double t_s) {
  const double x = 2.0 * std::sin(0.31 * t_s) + 0.3 * std::sin(1.3 * t_s);
  const double y = 1.5 * std::sin(0.47 * t_s + 1.0);
  const double yaw = 0.2 * t_s + 0.8 * std::sin(0.6 * t_s);
  return ToPose3({x, y, yaw});
}

Pose3 Flight(double t_s) {
  Pose3 pose = Drive(t_s);
  pose.translation.z() = 1.2 + 0.4 * std::sin(0.9 * t_s);
  pose.rotation = pose.rotation * RotationVector({0.3 * std::sin(1.1 * t_s), 0.25 * std::cos(0.8 * t_s), 0.0});
  return pose;
}

std::vector<PosePair> NoisyPairs(size_t count, uint64_t seed, double sigma, bool level) {
  Noise noise(seed);
  Pose3 T_map_world = RandomPose(noise, 5.0);
  if (level) T_map_world = ToPose3(ToPose2(T_map_world));
  std::vector<PosePair> pairs;
  int64_t utime = 5'000'000;
  for (size_t k = 0; k < count; ++k) {
    utime += static_cast<int64_t>(noise.Uniform(60'000, 140'000));
    const Pose3 reference = Flight(static_cast<double>(utime) * 1e-6);
    Pose3 estimate = T_map_world * reference;
    estimate.translation += noise.Gauss3(sigma);
    estimate.rotation = (estimate.rotation * RotationVector(noise.Gauss3(sigma))).normalized();
    pairs.push_back({utime, estimate, reference});
  }
  return pairs;
}

}  // namespace lcmslam::testing
