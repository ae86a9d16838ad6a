#include "octo3d/pipeline.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "lidar/pose_table.h"
#include "octo3d/coarse_search.h"
#include "octo3d/patches.h"

namespace lcmslam::octo3d {

namespace {

constexpr double kUsToS = 1e-6;

// A known pose, a velocity of which only the size is known.
StateBelief AtRest(const Pose3& T_map_body, const TrustOptions& trust) {
  StateBelief belief;
  belief.mean.T_map_body = T_map_body;
  Vector12 sigma;
  sigma << Vector6::Constant(1e-4), Eigen::Vector3d::Constant(trust.initial_speed_mps),
      Eigen::Vector3d::Constant(trust.initial_rate_radps);
  belief.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  return belief;
}

// Nothing moves on for ever unseen.
void Slow(MotionState& state) {
  state.velocity *= 0.5;
  state.angular_velocity *= 0.5;
}

}  // namespace

Pipeline::Pipeline(const Options& options) : options_(options), map_(options.map) { Reset(); }

Result Pipeline::Process(const Sweep& sweep, const MotionHint& hint) {
  if (IsStale(sweep)) return MakeResult(SweepStatus::kStale, {});
  const std::vector<Patch> patches = MakePatches(sweep, options_.patches, options_.map.range_noise_m);
  if (map_.num_cells() == 0) return Start(sweep);

  const TimedPatches timed{patches, FirstPointTime(sweep), kUsToS * static_cast<double>(sweep.utime - *utime_)};
  const RegistrationResult registration = RegisterSweep(timed, ToRelativeMotion(hint));
  const SweepStatus status = patches.empty()        ? SweepStatus::kNoPoints
                             : IsGood(registration) ? SweepStatus::kTracking
                                                    : SweepStatus::kDoubtful;
  belief_ = status == SweepStatus::kTracking ? registration.belief : registration.prediction;
  if (status != SweepStatus::kTracking) Slow(belief_.mean);
  utime_ = sweep.utime;
  Result result = MakeResult(status, registration);
  result.patches = static_cast<int>(patches.size());
  if (status == SweepStatus::kTracking && !options_.localise_only) {
    Insert({sweep, timed.first_dt_us, registration.motion});
    result.inserted = true;
  }
  return result;
}

bool Pipeline::IsStale(const Sweep& sweep) { return utime_.has_value() && sweep.utime <= *utime_; }

Result Pipeline::Start(const Sweep& sweep) {
  utime_ = sweep.utime;
  const int32_t first_dt_us = FirstPointTime(sweep);
  const double duration_s = std::max(1e-3, -kUsToS * first_dt_us);
  const MotionState from = Extrapolate(belief_.mean, -duration_s);
  Insert({sweep, first_dt_us, MotionSegment(from, belief_.mean, duration_s)});
  Result result = MakeResult(map_.num_cells() > 0 ? SweepStatus::kStarted : SweepStatus::kNoPoints, {});
  result.inserted = map_.num_cells() > 0;
  return result;
}

// While the map is young, the motion within its last sweep is known only now that the next one has come: both are found
// in turn.
RegistrationResult Pipeline::RegisterSweep(const TimedPatches& patches, const RelativeMotion& hint) {
  constexpr int kYoungRounds = 3;
  RegistrationResult registration = RegisterFromAnywhere(patches, hint);
  for (int round = 0; round < kYoungRounds && !young_.empty() && IsGood(registration); ++round) {
    Restraighten(registration.motion.from());
    registration = Register(map_, patches, belief_, hint, registration.motion, options_.registration);
  }
  return registration;
}

// From the prediction; where that leads to nothing good, from what a wider search makes of it, and of standing still.
RegistrationResult Pipeline::RegisterFromAnywhere(const TimedPatches& patches, const RelativeMotion& hint) {
  const MotionSegment predicted = PredictMotion(belief_, hint, patches.duration_s);
  RegistrationResult best = Register(map_, patches, belief_, hint, predicted, options_.registration);
  MotionState still = belief_.mean;
  still.velocity.setZero();
  still.angular_velocity.setZero();
  for (const MotionState& guess : {predicted.to(), still}) {
    if (IsGood(best)) break;
    const MotionSegment motion(belief_.mean, guess, patches.duration_s);
    MotionState to = guess;
    to.T_map_body = SearchCoarsely(map_, patches, motion, options_.search).T_map_body;
    const MotionSegment found(belief_.mean, to, patches.duration_s);
    const RegistrationResult other = Register(map_, patches, belief_, hint, found, options_.registration);
    if (other.inlier_ratio * other.matched > best.inlier_ratio * best.matched) best = other;
  }
  return best;
}

void Pipeline::Restraighten(const MotionState& last) {
  MotionSegment& motion = young_.back().motion;
  const bool first = young_.size() == 1;
  const MotionState from = first ? Extrapolate(last, -motion.duration_s()) : motion.from();
  motion = MotionSegment(from, last, motion.duration_s());
  std::vector<PlacedSweep> sweeps = std::move(young_);
  young_.clear();
  map_.Clear();
  for (PlacedSweep& placed : sweeps) Insert(placed);
}

bool Pipeline::IsGood(const RegistrationResult& registration) const {
  const TrustOptions& trust = options_.trust;
  return registration.status != RegistrationStatus::kTooFewPatches && registration.matched >= trust.min_patches &&
         registration.inlier_ratio >= trust.min_inlier_ratio &&
         registration.normalised_residual <= trust.max_residual && registration.belief.mean.T_map_body.IsFinite();
}

void Pipeline::Insert(const PlacedSweep& placed) {
  const double duration_us = placed.motion.duration_s() / kUsToS;
  const PoseTable poses(placed.first_dt_us, [&](double dt_us) { return placed.motion.At(1.0 + dt_us / duration_us); });
  const double min2 = options_.patches.min_range_m * options_.patches.min_range_m;
  const double max2 = options_.patches.max_range_m * options_.patches.max_range_m;
  std::vector<Eigen::Vector3f> points;
  points.reserve(placed.sweep.points.size());
  for (const SweepPoint& point : placed.sweep.points) {
    const Eigen::Vector3d p(point.x, point.y, point.z);
    const double range2 = p.squaredNorm();
    if (!(range2 >= min2 && range2 <= max2)) continue;  // also NaN
    points.push_back((poses[PoseTable::Slot(point.dt_us, placed.first_dt_us)] * p).cast<float>());
  }
  if (points.empty()) return;
  map_.Insert(points, placed.motion.to().T_map_body.translation.cast<float>());
  const bool young = map_.viewpoints().size() <= static_cast<size_t>(options_.trust.young_sweeps);
  if (young) {
    young_.push_back(placed);
  } else {
    young_.clear();
  }
}

RelativeMotion Pipeline::ToRelativeMotion(const MotionHint& hint) const {
  const auto information = [](double sigma) { return Eigen::Vector3d::Constant(1.0 / (sigma * sigma)); };
  const TrustOptions& trust = options_.trust;
  RelativeMotion motion;
  if (hint.odometry) {
    motion.T_from_to = *hint.odometry;
    motion.information << information(trust.hint_translation_m), information(trust.hint_odometry_rad);
  }
  if (hint.rotation) {
    motion.T_from_to.rotation = *hint.rotation;
    motion.information.tail<3>() = information(trust.hint_rotation_rad);
  }
  return motion;
}

Result Pipeline::MakeResult(SweepStatus status, const RegistrationResult& registration) const {
  Result result;
  result.status = status;
  result.utime = utime_.value_or(0);
  result.T_map_body = belief_.mean.T_map_body;
  result.velocity = belief_.mean.velocity;
  result.angular_velocity = belief_.mean.angular_velocity;
  result.covariance = belief_.information.ldlt().solve(Matrix12::Identity()).topLeftCorner<6, 6>();
  result.held = registration.held;
  result.iterations = registration.iterations;
  result.matched = registration.matched;
  result.inlier_ratio = registration.inlier_ratio;
  result.residual_m = registration.residual_m;
  return result;
}

void Pipeline::Reset() {
  map_.Clear();
  SetPose(Pose3{});
}

void Pipeline::SetPose(const Pose3& T_map_body) {
  belief_ = AtRest(T_map_body, options_.trust);
  utime_.reset();
  young_.clear();
}

void Pipeline::SetMap(SurfelMap map) {
  map_ = std::move(map);
  young_.clear();
}

}  // namespace lcmslam::octo3d
