#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "geometry/trajectory.h"
#include "trajectory/association.h"

namespace lcmslam::testing {

// Seeded noise that is the same on every platform.
class Noise {
 public:
  explicit Noise(uint64_t seed) : random_(seed) {}
  double Uniform(double low, double high);
  double Gauss(double sigma);  // Box-Muller
  Eigen::Vector3d Gauss3(double sigma) { return {Gauss(sigma), Gauss(sigma), Gauss(sigma)}; }

 private:
  std::mt19937_64 random_;
};

Eigen::Quaterniond RotationVector(const Eigen::Vector3d& rotation_rad);
Pose3 RandomPose(Noise& noise, double size_m);

// The pose at each stamp from 0 to duration, period apart.
Trajectory Sample(const std::function<Pose3(double t_s)>& motion, double duration_s, double period_s,
                  int64_t start_utime = 1'000'000'000);

// A planar drive with changing speed and curvature, at z = 0, and the same with heave, roll and pitch.
Pose3 Drive(double t_s);
Pose3 Flight(double t_s);

// Pairs along Flight(), the estimate in a frame of its own (a level one: turned about z only) and with noise.
std::vector<PosePair> NoisyPairs(size_t count, uint64_t seed, double sigma, bool level = false);

}  // namespace lcmslam::testing
