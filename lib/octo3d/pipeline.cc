#include "octo3d/pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "lidar/pose_table.h"
#include "octo3d/coarse_search.h"
#include "octo3d/patches.h"
#include "octo3d/thinning.h"

namespace lcmslam::octo3d {

namespace {

constexpr double kUsToS = 1e-6;
constexpr double kMapPoseM = 1e-4, kMapPoseRad = 1e-4;  // the first pose defines the map frame
constexpr double kLongestWalkS = 10.0;                  // beyond, more silence makes nothing worse
constexpr double kStartMotionM = 0.02;                  // of points during the first sweep
constexpr int kStartRounds = 4;
constexpr double kRestChi2 = 22.5;                         // one in a thousand, of six degrees of freedom
constexpr double kRestSpeedMps = 0.01, kRestRadps = 0.01;  // of a lidar that begins at rest
constexpr size_t kYoungSweeps = 10;                        // a map of fewer gains by every sweep, at rest too

// Pose known to within pose_m and pose_rad; of the velocity only the size is known.
StateBelief AtRest(const Pose3& T_map_body, double pose_m, double pose_rad, const TrustOptions& trust) {
  StateBelief belief;
  belief.mean.T_map_body = T_map_body;
  Vector12 sigma;
  sigma << Eigen::Vector3d::Constant(pose_m), Eigen::Vector3d::Constant(pose_rad),
      Eigen::Vector3d::Constant(trust.initial_speed_mps), Eigen::Vector3d::Constant(trust.initial_rate_radps);
  belief.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  return belief;
}

// How long the sweep itself took; never zero.
double SweepDuration(const Sweep& sweep) { return std::max(1e-3, -kUsToS * FirstPointTime(sweep)); }

// What counts when registrations of one sweep are compared: patches that fit.
double Fit(const RegistrationResult& registration) { return registration.inlier_ratio * registration.matched; }

// The velocity at which a first sweep is to be deskewed, from that of the second one's registration to it. Where the
// first is off by v (1 - f) at the fraction f of its turn, the steady motion v' f of the second that fits best has
// v' = 3/2 v: so two thirds of the difference are due.
MotionState Corrected(const MotionState& assumed, const MotionSegment& found) {
  const Vector12 change = Difference(found.to(), found.from());
  MotionState state = assumed;
  state.velocity += 2.0 / 3.0 * (change.head<3>() / found.duration_s() - assumed.velocity);
  state.angular_velocity += 2.0 / 3.0 * (change.segment<3>(3) / found.duration_s() - assumed.angular_velocity);
  return state;
}

// How far points a few metres away move within duration_s.
double MotionOfPoints(const MotionState& state, double duration_s) {
  constexpr double kLeverM = 3.0;
  return duration_s * (state.velocity.norm() + kLeverM * state.angular_velocity.norm());
}

// Whether motion would show, and what shows means nothing beside its uncertainty.
bool IsAtRest(const MotionState& before, const RegistrationResult& registration, double min_direction_share) {
  const Vector12 motion = Difference(registration.belief.mean, before);
  return UnobservableDirections(registration.measured, min_direction_share).cols() == 0 &&
         motion.dot(registration.belief.information * motion) < kRestChi2;
}

// Nothing moves on for ever unseen.
void Slow(MotionState& state) {
  state.velocity *= 0.5;
  state.angular_velocity *= 0.5;
}

}  // namespace

Pipeline::Pipeline(const Options& options) : options_(options), map_(options.map) { Reset(); }

Result Pipeline::Process(const Sweep& dense_sweep, const MotionHint& hint) {
  if (utime_ && dense_sweep.utime <= *utime_) return MakeResult(SweepStatus::kStale, {});
  StartClock();
  Sweep sweep = dense_sweep;
  Thin(sweep.points, static_cast<size_t>(options_.max_points));
  const std::vector<Patch> patches = MakePatches(sweep, options_.patches, options_.map.range_noise_m);
  Charge(Stage::kCondense);
  AwaitInsertion();
  if (map_.num_cells() == 0 && !options_.localize_only) return Start(sweep, patches);

  const TimedPatches timed{patches, FirstPointTime(sweep), BridgeTimeTo(sweep)};
  bool searched = false;
  bool began_anew = false;
  RegistrationResult registration = RegisterFromAnywhere(timed, ToRelativeMotion(hint), searched);
  if (first_) registration = ReconsiderStart(timed, ToRelativeMotion(hint), registration, began_anew);
  Charge(Stage::kRegister);

  const bool good = IsGood(registration);
  belief_ = good ? registration.belief : registration.prediction;
  if (!good) Slow(belief_.mean);
  utime_ = sweep.utime;
  const SweepStatus doubt = patches.empty() ? SweepStatus::kNoPoints : SweepStatus::kDoubtful;
  Result result = MakeResult(good ? SweepStatus::kTracking : doubt, registration);
  result.patches = static_cast<int>(patches.size());
  result.searched = good && searched;
  result.began_anew = began_anew;
  result.inserted = good && !options_.localize_only && MovedEnough() && Insert(sweep, registration.motion);
  Charge(Stage::kInsert);
  result.stage_ms = stage_ms_;
  return result;
}

// The first sweep makes the map: at the pose that was set, and as if at rest.
Result Pipeline::Start(const Sweep& sweep, const std::vector<Patch>& patches) {
  belief_ = AtRest(belief_.mean.T_map_body, kMapPoseM, kMapPoseRad, options_.trust);
  utime_ = sweep.utime;
  Result result = MakeResult(patches.empty() ? SweepStatus::kNoPoints : SweepStatus::kStarted, {});
  result.patches = static_cast<int>(patches.size());
  result.inserted = Insert(sweep, MotionSegment(belief_.mean, belief_.mean, SweepDuration(sweep)));
  if (result.inserted) first_ = sweep;
  Charge(Stage::kInsert);
  result.stage_ms = stage_ms_;
  return result;
}

// The time from the last state to the sweep's end. After a silence the velocity says nothing any more, and the pose as
// much as one can move in that time.
double Pipeline::BridgeTimeTo(const Sweep& sweep) {
  if (!utime_) return SweepDuration(sweep);
  const TrustOptions& trust = options_.trust;
  const double silence_s = kUsToS * (static_cast<double>(sweep.utime) - static_cast<double>(*utime_));
  if (silence_s <= trust.max_gap_s) return silence_s;
  const double moving_s = std::min(silence_s, kLongestWalkS);
  belief_ =
      AtRest(belief_.mean.T_map_body, trust.initial_speed_mps * moving_s, trust.initial_rate_radps * moving_s, trust);
  return trust.max_gap_s;
}

// From the prediction; where that leads to nothing good, from what a wider search makes of it, and of standing still.
RegistrationResult Pipeline::RegisterFromAnywhere(const TimedPatches& patches, const RelativeMotion& hint,
                                                  bool& searched) {
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
    if (Fit(other) <= Fit(best)) continue;
    best = other;
    searched = true;
  }
  return best;
}

// The first sweep went into the map as if at rest. When the second agrees, it is registered as at rest too: with any
// velocity possible, what two sweeps differ in by chance would be taken for motion. When it says that the lidar was
// moving, the map begins anew with that motion, unless this fits worse.
RegistrationResult Pipeline::ReconsiderStart(const TimedPatches& patches, const RelativeMotion& hint,
                                             const RegistrationResult& from_rest, bool& began_anew) {
  const Sweep first = *std::exchange(first_, std::nullopt);
  const double first_s = SweepDuration(first);
  if (options_.localize_only || patches.duration_s >= options_.trust.max_gap_s) return from_rest;
  if (IsGood(from_rest) && IsAtRest(belief_.mean, from_rest, options_.registration.min_direction_share)) {
    TrustOptions rest = options_.trust;
    rest.initial_speed_mps = std::min(rest.initial_speed_mps, kRestSpeedMps);
    rest.initial_rate_radps = std::min(rest.initial_rate_radps, kRestRadps);
    belief_ = AtRest(belief_.mean.T_map_body, kMapPoseM, kMapPoseRad, rest);
    return Register(map_, patches, belief_, hint, from_rest.motion, options_.registration);
  }
  if (MotionOfPoints(Corrected(belief_.mean, from_rest.motion), first_s) < kStartMotionM) return from_rest;
  const StateBelief at_rest = belief_;
  const auto begin = [&](const MotionState& end) {
    belief_.mean = end;
    map_.Clear();
    Insert(first, MotionSegment(Extrapolate(end, -first_s), end, first_s));
    AwaitInsertion();
  };
  RegistrationResult registration = from_rest;
  for (int round = 0; round < kStartRounds; ++round) {
    begin(Corrected(belief_.mean, registration.motion));
    bool searched = false;
    registration = RegisterFromAnywhere(patches, hint, searched);
  }
  // More patches that fit, and more closely.
  const auto score = [](const RegistrationResult& r) {
    return Fit(r) / (r.normalized_residual * r.normalized_residual);
  };
  began_anew = IsGood(registration) && score(registration) > score(from_rest);
  if (began_anew) return registration;
  begin(at_rest.mean);
  return from_rest;
}

bool Pipeline::IsGood(const RegistrationResult& registration) const {
  const TrustOptions& trust = options_.trust;
  return registration.status != RegistrationStatus::kTooFewPatches && registration.matched >= trust.min_patches &&
         registration.inlier_ratio >= trust.min_inlier_ratio &&
         registration.normalized_residual <= trust.max_residual && registration.belief.mean.T_map_body.IsFinite();
}

bool Pipeline::MovedEnough() const {
  if (!T_map_inserted_ || map_.viewpoints().size() < kYoungSweeps) return true;
  const Pose3 motion = T_map_inserted_->inverse() * belief_.mean.T_map_body;
  return Reaches(motion, options_.update_distance_m, options_.update_angle_rad);
}

// False when there was no point to insert.
bool Pipeline::Insert(const Sweep& sweep, const MotionSegment& motion) {
  const double duration_us = motion.duration_s() / kUsToS;
  const TimeSlots slots(FirstPointTime(sweep));
  const PoseTable poses(slots, [&](double dt_us) { return motion.At(1.0 + dt_us / duration_us); });
  std::vector<Eigen::Vector3f> points;
  points.reserve(sweep.points.size());
  for (const SweepPoint& point : sweep.points) {
    if (!InRange(point, options_.patches)) continue;
    points.push_back((poses[slots.SlotOf(point.dt_us)] * Eigen::Vector3d(point.x, point.y, point.z)).cast<float>());
  }
  if (points.empty()) return false;
  T_map_inserted_ = motion.to().T_map_body;
  const auto insert = [this, points = std::move(points), viewpoint = motion.to().T_map_body.translation] {
    map_.Insert(points, viewpoint.cast<float>());
  };
  if (options_.threads > 1) {
    insertion_ = std::async(std::launch::async, insert);
  } else {
    insert();
  }
  return true;
}

void Pipeline::AwaitInsertion() const {
  if (insertion_.valid()) insertion_.get();
}

const SurfelMap& Pipeline::map() const {
  AwaitInsertion();
  return map_;
}

void Pipeline::StartClock() {
  stage_ms_ = {};
  if (now_ms_) last_ms_ = now_ms_();
}

// Adds the time since the last call to a stage.
void Pipeline::Charge(Stage stage) {
  if (!now_ms_) return;
  const double now = now_ms_();
  stage_ms_[static_cast<size_t>(stage)] += now - last_ms_;
  last_ms_ = now;
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
  result.unobservable = registration.unobservable;
  result.iterations = registration.iterations;
  result.matched = registration.matched;
  result.inlier_ratio = registration.inlier_ratio;
  result.residual_m = registration.residual_m;
  return result;
}

void Pipeline::Reset() {
  AwaitInsertion();
  map_.Clear();
  SetPose(Pose3{});
}

void Pipeline::SetPose(const Pose3& T_map_body) {
  belief_ = AtRest(T_map_body, options_.trust.set_pose_m, options_.trust.set_pose_rad, options_.trust);
  utime_.reset();
  first_.reset();
  T_map_inserted_.reset();
}

void Pipeline::SetMap(SurfelMap map) {
  AwaitInsertion();
  map_ = std::move(map);
}

}  // namespace lcmslam::octo3d
