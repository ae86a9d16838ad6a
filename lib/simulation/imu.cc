#include "simulation/imu.h"

#include <cmath>

#include <boost/random/normal_distribution.hpp>

#include "simulation/random.h"

namespace lcmslam {
namespace {

using Eigen::Vector3d;

class Noise {
 public:
  explicit Noise(uint64_t seed) : rng_(MakeRng(seed, RandomStream::kImu)) {}
  Vector3d Draw(double sigma) {
    const double x = normal_(rng_), y = normal_(rng_), z = normal_(rng_);
    return sigma * Vector3d(x, y, z);
  }

 private:
  Rng rng_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace

std::string ImuOptions::Validate() const {
  const auto is_bad = [](double value) { return !(value >= 0.0) || !std::isfinite(value); };
  if (is_bad(rate_hz) || rate_hz > 1e3) return "rate_hz: must be in 0..1000";
  if (is_bad(gyroscope_noise_radps_per_sqrt_hz)) return "gyroscope_noise_radps_per_sqrt_hz: must not be negative";
  if (is_bad(gyroscope_bias_sigma_radps)) return "gyroscope_bias_sigma_radps: must not be negative";
  if (is_bad(gyroscope_walk_radps2_per_sqrt_hz)) return "gyroscope_walk_radps2_per_sqrt_hz: must not be negative";
  if (is_bad(accelerometer_noise_mps2_per_sqrt_hz)) return "accelerometer_noise_mps2_per_sqrt_hz: must not be negative";
  if (is_bad(accelerometer_bias_sigma_mps2)) return "accelerometer_bias_sigma_mps2: must not be negative";
  if (is_bad(accelerometer_walk_mps3_per_sqrt_hz)) return "accelerometer_walk_mps3_per_sqrt_hz: must not be negative";
  return "";
}

std::vector<ImuSample> SimulateImu(const SpatialMotion& motion, int64_t start_utime, const ImuOptions& options,
                                   uint64_t seed) {
  std::vector<ImuSample> samples;
  if (options.rate_hz == 0.0) return samples;
  const double sqrt_rate = std::sqrt(options.rate_hz);
  Noise noise(seed);
  Vector3d gyroscope_bias = noise.Draw(options.gyroscope_bias_sigma_radps);
  Vector3d accelerometer_bias = noise.Draw(options.accelerometer_bias_sigma_mps2);
  const auto count = static_cast<size_t>(std::floor(motion.duration_s() * options.rate_hz)) + 1;
  samples.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) / options.rate_hz;
    const BodyState body = motion.StateAt(t_s);
    const Vector3d specific_force =
        body.T_world_body.rotation.conjugate() * (body.acceleration_mps2 + kGravity_mps2 * Vector3d::UnitZ());
    const Vector3d gyroscope_noise = noise.Draw(options.gyroscope_noise_radps_per_sqrt_hz * sqrt_rate);
    const Vector3d accelerometer_noise = noise.Draw(options.accelerometer_noise_mps2_per_sqrt_hz * sqrt_rate);
    samples.push_back({.utime = start_utime + std::llround(1e6 * t_s),
                       .angular_velocity_radps = body.angular_velocity_radps + gyroscope_bias + gyroscope_noise,
                       .specific_force_mps2 = specific_force + accelerometer_bias + accelerometer_noise});
    gyroscope_bias += noise.Draw(options.gyroscope_walk_radps2_per_sqrt_hz / sqrt_rate);
    accelerometer_bias += noise.Draw(options.accelerometer_walk_mps3_per_sqrt_hz / sqrt_rate);
  }
  return samples;
}

}  // namespace lcmslam
