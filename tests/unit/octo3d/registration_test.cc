#include "octo3d/registration.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "lidar/pose_table.h"
#include "octo3d/coarse_search.h"
#include "octo3d/plane_constraints.h"
#include "octo3d/sweep_information.h"

namespace lcmslam::octo3d {
namespace {

constexpr int32_t kFirstDtUs = -100000;
constexpr double kDurationS = 0.1;

// A closed box; walls off the cell borders.
struct Box {
  Eigen::Vector3d half{3.07, 2.33, 1.41};

  Eigen::Vector3d WallPoint(std::mt19937_64& random) const {
    std::uniform_real_distribution<double> uniform(-0.98, 0.98);
    Eigen::Vector3d p = half.cwiseProduct(Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
    const int axis = static_cast<int>(random() % 3);
    p[axis] = random() % 2 == 0 ? half[axis] : -half[axis];
    return p;
  }
};

SurfelMap BoxMap(const Box& box) {
  std::mt19937_64 random(1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100000; ++i) points.push_back(box.WallPoint(random).cast<float>());
  SurfelMap map{MapOptions{}};
  map.Insert(points, Eigen::Vector3f::Zero());
  return map;
}

// What the moving lidar sees of the box, a patch a point.
std::vector<Patch> SeenFrom(const Box& box, const MotionSegment& motion, int n) {
  std::mt19937_64 random(2);
  const TimeSlots slots(kFirstDtUs);
  std::vector<Patch> patches(n);
  for (int i = 0; i < n; ++i) {
    patches[i].slot = static_cast<uint16_t>(int64_t{i} * TimeSlots::kSlots / n);
    patches[i].count = 10.0F;
    const Pose3 T_map_lidar = motion.At(1.0 + 1e-6 * slots.MiddleUs(patches[i].slot) / kDurationS);
    patches[i].mean = T_map_lidar.inverse() * box.WallPoint(random);
  }
  return patches;
}

MotionState Moving() {
  MotionState state;
  state.T_map_body = {{0.2, -0.3, 0.1}, ExpRotation({0.05, -0.02, 0.4})};
  state.velocity = {0.8, 0.3, -0.1};
  state.angular_velocity = {0.1, -0.2, 0.7};
  return state;
}

StateBelief Belief(const MotionState& mean, double pose_sigma, double velocity_sigma) {
  Vector12 sigma;
  sigma << Vector6::Constant(pose_sigma), Vector6::Constant(velocity_sigma);
  return {mean, Matrix12(sigma.cwiseAbs2().cwiseInverse().asDiagonal())};
}

TEST(Register, FindsTheMotionWithinTheSweep) {
  const Box box;
  const SurfelMap map = BoxMap(box);
  Vector12 change;  // the velocity changes within the sweep
  change << 0.004, -0.003, 0.002, 0.003, 0.002, -0.004, 0.08, -0.06, 0.04, 0.05, 0.03, -0.06;
  const MotionState from = Moving();
  const MotionSegment truth(from, Add(Extrapolate(from, kDurationS), change), kDurationS);
  const std::vector<Patch> patches = SeenFrom(box, truth, 3000);
  // All that is believed beforehand is off by a centimetre and a tenth of a metre a second.
  Vector12 off;
  off << Vector6::Constant(0.01), Vector6::Constant(0.1);
  const StateBelief belief = Belief(Add(from, off), 0.02, 0.2);
  const RegistrationOptions options;
  const RegistrationResult result =
      Register(map, {patches, kFirstDtUs, kDurationS}, belief, {}, PredictMotion(belief, {}, kDurationS), options);
  EXPECT_EQ(result.status, RegistrationStatus::kConverged);
  EXPECT_GT(result.inlier_ratio, 0.99);
  EXPECT_EQ(result.unobservable.cols(), 0);
  for (const double s : {0.0, 0.5, 1.0}) {
    EXPECT_LT((result.motion.At(s).translation - truth.At(s).translation).norm(), 0.002) << s;
    EXPECT_LT(AngleBetween(result.motion.At(s).rotation, truth.At(s).rotation), 0.002) << s;
  }
  EXPECT_LT((result.motion.to().velocity - truth.to().velocity).norm(), 0.08);
}

TEST(Register, KnowsMoreThanThePredictionAndNothingWithoutPatches) {
  const Box box;
  const SurfelMap map = BoxMap(box);
  const MotionSegment truth(Moving(), Extrapolate(Moving(), kDurationS), kDurationS);
  const std::vector<Patch> patches = SeenFrom(box, truth, 500);
  const StateBelief belief = Belief(Moving(), 0.02, 0.2);
  const MotionSegment guess = PredictMotion(belief, {}, kDurationS);
  const RegistrationResult seen = Register(map, {patches, kFirstDtUs, kDurationS}, belief, {}, guess, {});
  const Matrix12 gain = seen.belief.information - seen.prediction.information;
  EXPECT_GT(gain.ldlt().vectorD().minCoeff(), -1e-6 * gain.trace()) << "information only grows";

  const RegistrationResult blind = Register(map, {{}, kFirstDtUs, kDurationS}, belief, {}, guess, {});
  EXPECT_EQ(blind.status, RegistrationStatus::kTooFewPatches);
  EXPECT_LT(Difference(blind.belief.mean, Extrapolate(Moving(), kDurationS)).norm(), 1e-12);
  EXPECT_EQ(blind.belief.information, blind.prediction.information);
}

TEST(Register, PredictionCovarianceIsThatOfAKalmanFilter) {
  const StateBelief belief = Belief(Moving(), 0.02, 0.2);
  const RegistrationOptions options;
  const MotionSegment guess = PredictMotion(belief, {}, kDurationS);
  const RegistrationResult blind = Register(SurfelMap{MapOptions{}}, {{}, 0, kDurationS}, belief, {}, guess, options);
  const MotionPrior prior = EvaluateMotionPrior(guess, options.acceleration_mps2, options.angular_acceleration_radps2);
  const Matrix12 P =
      prior.transition * belief.information.inverse() * prior.transition.transpose() + prior.information.inverse();
  EXPECT_LT((blind.prediction.information * P - Matrix12::Identity()).norm(), 1e-6);
}

// The oracle: the equations of Register()'s header in double precision, patch by patch.
TEST(PlaneConstraints, AgreeWithEquationsInDoublePrecisionFarOut) {
  const Eigen::Vector3d far(2000.0, -1500.0, 80.0);
  const Box box;
  std::mt19937_64 random(4);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100000; ++i) points.push_back((far + box.WallPoint(random)).cast<float>());
  SurfelMap map{MapOptions{}};
  map.Insert(points, far.cast<float>());

  const MotionSegment motion(Moving(), Extrapolate(Moving(), kDurationS), kDurationS);
  std::vector<Patch> patches = SeenFrom(box, motion, 700);
  patches[5].mean.x() = std::numeric_limits<double>::quiet_NaN();
  const RegistrationOptions options;
  const TimeSlots slots(kFirstDtUs);
  PlaneConstraints constraints(map, patches, options, far);
  for (const double shift_m : {0.0, 0.004, 0.05}) {  // within what a plane is kept for, and beyond
    const PoseTable poses(slots, [&](double dt_us) {
      Pose3 pose = motion.At(1.0 + 1e-6 * dt_us / kDurationS);
      pose.translation += far + Eigen::Vector3d::Constant(shift_m);
      return pose;
    });
    SweepInformation information;
    const double floor_m = 0.02;
    const ConstraintFit fit = constraints.AddTo(information, poses, floor_m);
    Matrix6 H = Matrix6::Zero();
    double squares = 0.0;
    int matched = 0;
    for (const Patch& patch : patches) {
      const Eigen::Vector3d p = poses[patch.slot] * patch.mean;
      // Planes are kept for a centimetre: the second time they are those of the first.
      const double kept_m = shift_m < 0.01 ? shift_m : 0.0;
      const PlaneMatch plane = map.Find(p - Eigen::Vector3d::Constant(kept_m));
      if (!plane.found) continue;
      ++matched;
      const double range_var = std::pow(map.options().range_noise_m, 2);
      const double plane_var = plane.variance + std::pow(options.model_error_m, 2);
      const double residual = plane.normal.dot(p - plane.mean);
      const double kernel = options.kernel * std::sqrt(range_var + plane_var) + floor_m;
      const double ratio = kernel * kernel / (kernel * kernel + residual * residual);
      Vector6 J;
      J << plane.normal, (poses[patch.slot].R_map_lidar * patch.mean).cross(plane.normal);
      H += ratio * ratio / (range_var / patch.count + plane_var) * J * J.transpose();
      if (std::abs(residual) < 3.0 * std::sqrt(range_var + plane_var) + floor_m) squares += residual * residual;
    }
    EXPECT_EQ(fit.matched, matched) << shift_m;
    EXPECT_GT(fit.matched, 600);
    EXPECT_LT((information.Total() - H).norm(), 1e-4 * H.norm()) << shift_m;
    EXPECT_NEAR(fit.squares, squares, 1e-4 * squares + 1e-6) << shift_m;
  }
}

// The oracle: every normal tilted at random by as much as the map says that it may be off.
TEST(PlaneConstraints, NoiseOfNormalsIsWhatTiltedNormalsAdd) {
  const Box box;
  const SurfelMap map = BoxMap(box);
  const MotionSegment motion(Moving(), Extrapolate(Moving(), kDurationS), kDurationS);
  const std::vector<Patch> patches = SeenFrom(box, motion, 500);
  const RegistrationOptions options;
  const TimeSlots slots(kFirstDtUs);
  const PoseTable poses(slots, [&](double dt_us) { return motion.At(1.0 + 1e-6 * dt_us / kDurationS); });
  PlaneConstraints constraints(map, patches, options, Eigen::Vector3d::Zero());
  SweepInformation information;
  (void)constraints.AddTo(information, poses, 0.0);
  const Matrix6 noise = constraints.NoiseOfNormals(0.0);

  std::mt19937_64 random(6);
  const int trials = 400;
  Matrix6 gain = Matrix6::Zero();
  for (const Patch& patch : patches) {
    const PlaneMatch plane = map.Find(poses[patch.slot] * patch.mean);
    if (!plane.found) continue;
    const double range_var = std::pow(map.options().range_noise_m, 2);
    const double plane_var = plane.variance + std::pow(options.model_error_m, 2);
    const double residual = plane.normal.dot(poses[patch.slot] * patch.mean - plane.mean);
    const double kernel2 = std::pow(options.kernel, 2) * (range_var + plane_var);
    const double weight =
        std::pow(kernel2 / (kernel2 + residual * residual), 2) / (range_var / patch.count + plane_var);
    const Eigen::Vector3d lever = poses[patch.slot].R_map_lidar * patch.mean;
    const auto outer = [&](const Eigen::Vector3d& n) -> Matrix6 {
      Vector6 J;
      J << n, lever.cross(n);
      return J * J.transpose();
    };
    const Eigen::Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    const double tilt = std::sqrt(2.0 * plane.tilt_variance);
    for (int i = 0; i < trials; ++i) {  // towards any side, and back
      const double towards = 2.0 * M_PI * static_cast<double>(random()) / static_cast<double>(random.max());
      const Eigen::Vector3d off = tilt * (std::cos(towards) * u + std::sin(towards) * v);
      gain += weight / trials * (0.5 * (outer(plane.normal + off) + outer(plane.normal - off)) - outer(plane.normal));
    }
  }
  EXPECT_GT(noise.norm(), 0.0);
  EXPECT_LT((noise - gain).norm(), 0.02 * noise.norm());
}

TEST(SweepInformation, AgreesWithDenseNormalEquations) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const MotionSegment motion(Moving(), Extrapolate(Moving(), kDurationS), kDurationS);
  const TimeSlots slots(kFirstDtUs);
  SweepInformation information;
  information.Clear();
  Eigen::Matrix<double, 24, 24> H = Eigen::Matrix<double, 24, 24>::Zero(), H_dense = H;
  Eigen::Matrix<double, 24, 1> b = Eigen::Matrix<double, 24, 1>::Zero(), b_dense = b;
  Matrix6 total = Matrix6::Zero();
  for (int i = 0; i < 2000; ++i) {
    Vector6 J;
    for (double& v : J) v = uniform(random);
    const double residual = uniform(random), weight = 1.0 + uniform(random);
    const int slot = static_cast<int>(random() % TimeSlots::kSlots);
    const auto padded = [](const auto& v) { return Eigen::Vector4f(v[0], v[1], v[2], 1e9F); };
    information.Add(slot, padded(J.head<3>()), padded(J.tail<3>()), residual, weight);
    const Eigen::Vector4d h = motion.Influence(1.0 + 1e-6 * slots.MiddleUs(slot) / kDurationS);
    Eigen::Matrix<double, 24, 1> row;
    row << h[0] * J, h[1] * J, h[2] * J, h[3] * J;
    H_dense += weight * row * row.transpose();
    b_dense += weight * residual * row;
    total += weight * J * J.transpose();
  }
  information.AddTo(motion, slots, H, b);
  EXPECT_LT((information.Total() - total).norm(), 1e-6 * total.norm());
  EXPECT_LT((H - H_dense).norm(), 5e-3 * H_dense.norm()) << "times are rounded to bins";
  EXPECT_LT((b - b_dense).norm(), 5e-2 * b_dense.norm());
}

TEST(SearchCoarsely, FindsItsWayFromFarOff) {
  const Box box;
  const SurfelMap map = BoxMap(box);
  MotionState at_rest;
  const MotionSegment truth(at_rest, at_rest, kDurationS);
  const std::vector<Patch> patches = SeenFrom(box, truth, 1000);
  MotionState off = at_rest;
  off.T_map_body = {{0.4, -0.3, 0.1}, ExpRotation({0.05, 0.1, 0.35})};
  const CoarseSearchResult found =
      SearchCoarsely(map, {patches, kFirstDtUs, kDurationS}, MotionSegment(off, off, kDurationS), {});
  EXPECT_LT(found.T_map_body.translation.norm(), 0.02);
  EXPECT_LT(AngleBetween(found.T_map_body.rotation, Eigen::Quaterniond::Identity()), 0.02);
  EXPECT_GT(found.inlier_ratio, 0.9);
}

}  // namespace
}  // namespace lcmslam::octo3d
