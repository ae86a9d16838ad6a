#include "sdf2d/pipeline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "sdf2d/fusion.h"
#include "sdf2d/recovery.h"
#include "sdf2d/sudden_motion.h"
#include "sdf2d/surface.h"

namespace lcmslam::sdf2d {
namespace {

constexpr double kInlierSmoothing = 0.1;  // of the running mean, per scan, once there are ten

}  // namespace

Pipeline::Pipeline(const Options& options)
    : options_(options),
      map_(options.cell_m),
      coarse_map_(options.coarse_cell_m),
      motion_(options.motion, options.T_map_body_initial),
      noise_(options.noise),
      origin_body_(options.T_body_lidar.translation()) {}

Result Pipeline::Process(const PlanarScan& scan) {
  Result result{.utime = scan.utime, .T_map_body = motion_.state().T_map_body};
  if (now_ms_) last_ms_ = now_ms_();
  RestartClockIfItJumped(scan.utime);
  std::vector<ScanPoint> points =
      ReturnsInBody(scan, options_.T_body_lidar, options_.min_range_m, options_.max_range_m);
  if (!Accepts(scan.utime, points)) return result;
  for (ScanPoint& point : points) {
    if (!options_.deskew || std::abs(point.dt_s) > options_.motion.max_gap_s) point.dt_s = 0.0;
  }
  noise_.Observe(points, origin_body_);
  const MotionState prediction = motion_.Predict(scan.utime);
  Charge(Stage::kPrepare, &result);

  const double dt_s = motion_.SecondsUntil(scan.utime);
  const Registration registration = Register(points, prediction, dt_s, &result);
  const MotionState& state = registration.align.state;
  motion_.Correct(scan.utime, state);
  if (registration.status != Status::kLost && MapIsDue(state.T_map_body)) UpdateMap(points, state, &result);

  result.status = registration.status;
  result.T_map_body = state.T_map_body;
  result.twist_body = state.twist_body;
  result.covariance = state.PoseCovarianceInMap();
  result.num_points = registration.align.points;
  result.iterations = registration.align.iterations;
  result.inlier_ratio = registration.align.InlierRatio();
  result.residual_rms_m = registration.align.residual_rms_m;
  result.range_sigma_m = noise_.Sigma(1.0);
  result.unobservable = registration.align.UnobservableAxes();
  return result;
}

Pipeline::Registration Pipeline::Register(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s,
                                          Result* result) {
  if (map_.empty()) {
    AlignResult begin;
    begin.state = prediction;
    begin.state.covariance.topLeftCorner<3, 3>().setZero();  // the map's frame is where it begins
    begin.points = static_cast<int>(points.size());
    return {begin, options_.localize_only ? Status::kLost : Status::kInitializing};
  }
  AlignResult align = AlignAsPredicted(points, prediction, dt_s);
  Charge(Stage::kRegister, result);
  if (IsDoubtful(align, prediction)) TryCoarseToFine(points, prediction, &align);
  const bool turned = IsDoubtful(align, prediction) && TrySuddenTurn(points, prediction, dt_s, &align);
  const bool good = IsGood(align, prediction) && motion_.started();  // a pose given by hand is only where to look
  if (!good) {
    const AlignResult found = Search(points, prediction);
    if (found.inliers > align.inliers) align = found;
  }
  Charge(Stage::kRecover, result);

  if (!good && align.InlierRatio() < options_.recovery.min_found_ratio) return GiveUp(prediction, align);
  const bool found = turned || !good || scans_lost_ > 0;
  scans_lost_ = 0;
  const double smoothing = std::max(kInlierSmoothing, 1.0 / ++scans_registered_);
  usual_inlier_ratio_ += smoothing * (align.InlierRatio() - usual_inlier_ratio_);
  if (found) return {align, Status::kRelocalized};
  return {align, align.unobservable.isZero() ? Status::kTracking : Status::kDegenerate};
}

AlignResult Pipeline::AlignAsPredicted(std::span<const ScanPoint> points, const MotionState& prediction,
                                       double dt_s) const {
  const RegistrationOptions& registration = options_.registration;
  const AlignResult align = Align(map_, points, origin_body_, noise_, prediction, registration);
  if (Skew_rad(points, prediction, dt_s, align.state.T_map_body) <= registration.max_skew_rad) return align;
  return AlignDeskewedAgain(map_, points, origin_body_, noise_, prediction, dt_s, align, registration);
}

void Pipeline::TryCoarseToFine(std::span<const ScanPoint> points, const MotionState& prediction,
                               AlignResult* align) const {
  const AlignResult wide =
      AlignCoarseToFine(map_, coarse_map_, points, origin_body_, noise_, prediction, options_.registration);
  if (wide.inliers > align->inliers) *align = wide;
}

bool Pipeline::TrySuddenTurn(std::span<const ScanPoint> points, const MotionState& prediction, double dt_s,
                             AlignResult* align) const {
  if (dt_s == 0.0 || options_.recovery.max_turn_rate == 0.0) return false;
  const AlignResult turned = AlignTurning(map_, coarse_map_, points, origin_body_, noise_, prediction, dt_s,
                                          options_.recovery.max_turn_rate, options_.registration);
  const bool as_good = IsGood(turned, prediction) || !IsGood(*align, prediction);
  if (!as_good || turned.inliers <= align->inliers) return false;
  *align = turned;
  return true;
}

AlignResult Pipeline::Search(std::span<const ScanPoint> points, const MotionState& prediction) const {
  const RecoveryOptions& recovery = options_.recovery;
  const double widening = std::exp2(std::min(scans_lost_, 10));
  return SearchAround(map_, coarse_map_, points, origin_body_, noise_, prediction,
                      std::min(recovery.search_m * widening, recovery.max_search_m),
                      std::min(recovery.search_rad * widening, std::numbers::pi), options_.registration);
}

// The prediction stands. After much patience it is believed: the map goes on from there.
Pipeline::Registration Pipeline::GiveUp(const MotionState& prediction, AlignResult align) {
  ++scans_lost_;
  align.state = prediction;
  align.state.twist_body.setZero();
  const int patience = options_.recovery.patience;
  if (options_.localize_only || patience == 0 || scans_lost_ < patience) return {align, Status::kLost};
  scans_lost_ = 0;
  return {align, Status::kInitializing};
}

bool Pipeline::MapIsDue(const Pose2& T_map_body) const {
  if (options_.localize_only) return false;
  return map_.empty() || Reaches(T_map_body_mapped_.inverse() * T_map_body, options_.fusion.update_distance_m,
                                 options_.fusion.update_angle_rad);
}

void Pipeline::UpdateMap(std::span<const ScanPoint> points, const MotionState& state, Result* result) {
  std::vector<Eigen::Vector2d> p_body;
  Deskew(points, state.twist_body, &p_body);
  const std::vector<SurfaceLine> lines = ExtractSurface(p_body, origin_body_, noise_, options_.surface);
  Charge(Stage::kExtract, result);

  for (SdfMap* map : {&map_, &coarse_map_}) {
    map->BeginRevision();
    field_.Rasterize(lines, state.T_map_body, map->cell_m(), options_.fusion);
    Fuse(field_, options_.fusion, map);
  }
  Charge(Stage::kFuse, result);

  const int first = static_cast<int>(scans_mapped_ % options_.fusion.carve_every);
  if (options_.fusion.carve) {
    for (SdfMap* map : {&map_, &coarse_map_}) {
      Carve(p_body, origin_body_, state.T_map_body, noise_, first, options_.fusion, map);
    }
  }
  ++scans_mapped_;
  T_map_body_mapped_ = state.T_map_body;
  Charge(Stage::kCarve, result);
}

bool Pipeline::IsSuspicious(const AlignResult& align) const {
  return align.InlierRatio() < usual_inlier_ratio_ - options_.recovery.suspicious_drop;
}

bool Pipeline::IsDoubtful(const AlignResult& align, const MotionState& prediction) const {
  return !IsGood(align, prediction) || IsSuspicious(align);
}

// Enough of the scan fell on mapped surface, and enough of that fits. What fits much less than usual must at least
// agree with the prediction.
bool Pipeline::IsGood(const AlignResult& align, const MotionState& prediction) const {
  const RecoveryOptions& recovery = options_.recovery;
  if (align.status == AlignStatus::kTooFewPoints) return false;
  if (align.matched < recovery.min_overlap * align.points) return false;
  if (align.inliers < recovery.min_inlier_ratio * align.matched) return false;
  if (!IsSuspicious(align)) return true;
  const Eigen::Vector3d off = (prediction.T_map_body.inverse() * align.state.T_map_body).Log();
  const Eigen::Matrix3d covariance = prediction.covariance.topLeftCorner<3, 3>();
  return off.dot(covariance.ldlt().solve(off)) < recovery.max_surprise_sigmas * recovery.max_surprise_sigmas;
}

bool Pipeline::Accepts(int64_t utime, std::span<const ScanPoint> points) const {
  if (static_cast<int>(points.size()) < options_.registration.min_points) return false;
  return !motion_.started() || utime > motion_.utime();
}

void Pipeline::RestartClockIfItJumped(int64_t utime) {
  const bool jumped_back = SecondsBetween(utime, motion_.utime()) > options_.motion.max_gap_s;
  if (motion_.started() && jumped_back) SetPose(motion_.state().T_map_body);
}

void Pipeline::Reset() {
  std::function<double()> now_ms = std::move(now_ms_);
  *this = Pipeline(options_);
  now_ms_ = std::move(now_ms);
}

void Pipeline::SetPose(const Pose2& T_map_body) { motion_.Restart(T_map_body); }

void Pipeline::SetMounting(const Pose2& T_body_lidar) {
  options_.T_body_lidar = T_body_lidar;
  origin_body_ = T_body_lidar.translation();
}

void Pipeline::SetMap(SdfMap map) {
  options_.cell_m = map.cell_m();
  coarse_map_ = Coarsen(map, options_.coarse_cell_m, options_.fusion);
  map_ = std::move(map);
}

void Pipeline::Charge(Stage stage, Result* result) {
  if (!now_ms_) return;
  const double now = now_ms_();
  result->stage_ms[static_cast<size_t>(stage)] += now - last_ms_;
  last_ms_ = now;
}

}  // namespace lcmslam::sdf2d
