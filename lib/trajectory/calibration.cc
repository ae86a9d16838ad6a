#include "trajectory/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "trajectory/calibration_problem.h"
#include "trajectory/summary.h"

namespace lcmslam {
namespace {

constexpr std::array<const char*, CalibrationProblem::kCalibrated> kParameterNames = {
    "time offset",      "lever arm x",      "lever arm y",     "lever arm z",
    "rotation about x", "rotation about y", "rotation about z"};

int64_t ToMicroseconds(double seconds) { return std::llround(seconds * 1e6); }

// At most max_count poses, evenly taken.
Trajectory Thin(std::span<const StampedPose> trajectory, size_t max_count) {
  const size_t stride = std::max<size_t>(1, (trajectory.size() + max_count - 1) / max_count);
  Trajectory thin;
  for (size_t i = 0; i < trajectory.size(); i += stride) thin.push_back(trajectory[i]);
  return thin;
}

std::vector<PosePair> AssociateAt(double time_offset_s, std::span<const StampedPose> estimate,
                                  std::span<const StampedPose> reference, const CalibrationOptions& options) {
  return Associate(estimate, reference,
                   {.max_gap_us = options.max_gap_us, .time_offset_us = ToMicroseconds(time_offset_s)})
      .pairs;
}

// The offset, of a grid, at which the aligned positions lie closest together: near enough for the joint problem.
double SearchTimeOffset(std::span<const StampedPose> estimate, std::span<const StampedPose> reference,
                        const CalibrationOptions& options) {
  constexpr double kGrid_s = 0.05;
  const Trajectory few = Thin(estimate, 1000);
  const int reach = static_cast<int>(options.max_time_offset_s / kGrid_s);
  double best_s = 0.0, best_rmse = std::numeric_limits<double>::infinity();
  size_t most_pairs = 0;
  for (int k = 0; k <= 2 * reach; ++k) {
    const double offset_s = kGrid_s * (k % 2 == 0 ? k / 2 : -(k + 1) / 2);  // 0 first: it wins ties
    std::vector<PosePair> pairs = AssociateAt(offset_s, few, reference, options);
    most_pairs = std::max(most_pairs, pairs.size());
    if (pairs.empty() || 2 * pairs.size() < most_pairs) continue;
    Apply(Align(pairs, options.alignment).T_world_map, pairs);
    double sum_squares = 0.0;
    for (const PosePair& pair : pairs) {
      sum_squares += (pair.reference.translation - pair.estimate.translation).squaredNorm();
    }
    const double rmse = std::sqrt(sum_squares / static_cast<double>(pairs.size()));
    if (rmse < best_rmse - 1e-12) std::tie(best_rmse, best_s) = std::tuple(rmse, offset_s);
  }
  return best_s;
}

// Half the window of a local motion: wide enough for five reference poses.
int64_t WindowHalfWidth(std::span<const StampedPose> reference) {
  std::vector<double> periods_us;
  for (size_t i = 1; i < reference.size(); ++i) {
    periods_us.push_back(static_cast<double>(reference[i].utime - reference[i - 1].utime));
  }
  return std::max<int64_t>(100'000, std::llround(2.5 * Percentile(periods_us, 0.5)));
}

std::vector<CalibrationSample> SamplesAt(double time_offset_s, std::span<const StampedPose> estimate,
                                         std::span<const StampedPose> reference, int64_t half_width_us,
                                         const CalibrationOptions& options) {
  std::vector<CalibrationSample> samples;
  for (const StampedPose& pose : estimate) {
    const int64_t utime = pose.utime + ToMicroseconds(time_offset_s);
    if (auto motion = FitLocalMotion(reference, utime, half_width_us, options.max_gap_us)) {
      samples.push_back({pose.pose, *motion});
    }
  }
  return samples;
}

// Solves in rounds: each fits the reference around the time offset and weighs by the noise that the last one found.
bool SolveInRounds(CalibrationProblem& problem, std::span<const StampedPose> estimate,
                   std::span<const StampedPose> reference, const CalibrationOptions& options) {
  constexpr int kRounds = 4;
  const int64_t half_width_us = WindowHalfWidth(reference);
  for (int round = 0; round < kRounds; ++round) {
    const double time_offset_s = problem.time_offset_s();
    const auto samples = SamplesAt(time_offset_s, estimate, reference, half_width_us, options);
    if (!problem.Solve(samples, time_offset_s)) return false;
  }
  return true;
}

bool IsExcited(const CalibrationProblem::Deviations& sd, int parameter, const CalibrationOptions& options) {
  const double limit = parameter == 0   ? options.max_time_offset_sd_s
                       : parameter <= 3 ? options.max_lever_arm_sd_m
                                        : options.max_rotation_sd_rad;
  return sd[parameter] <= limit;
}

}  // namespace

std::string CalibrationOptions::Validate() const {
  if (alignment != AlignmentKind::kSe2 && alignment != AlignmentKind::kSe3) return "alignment: must be se2 or se3";
  if (max_gap_us <= 0) return "max_gap_us: must be positive";
  if (!(max_time_offset_s >= 0.0 && max_time_offset_s <= 60.0)) return "max_time_offset_s: must be in [0, 60]";
  if (!(huber_sigmas > 0.0)) return "huber_sigmas: must be positive";
  if (!(max_time_offset_sd_s > 0.0)) return "max_time_offset_sd_s: must be positive";
  if (!(max_lever_arm_sd_m > 0.0)) return "max_lever_arm_sd_m: must be positive";
  if (!(max_rotation_sd_rad > 0.0)) return "max_rotation_sd_rad: must be positive";
  if (max_pairs < 10) return "max_pairs: must be at least 10";
  return "";
}

Calibration Calibrate(std::span<const StampedPose> estimate_full, std::span<const StampedPose> reference,
                      const CalibrationOptions& options) {
  Calibration result;
  const Trajectory estimate = Thin(estimate_full, options.max_pairs);
  const double time_offset_guess_s = SearchTimeOffset(estimate, reference, options);
  const std::vector<PosePair> pairs = AssociateAt(time_offset_guess_s, estimate, reference, options);
  constexpr size_t kFewest = 10;
  if (pairs.size() < kFewest) return result;

  const Pose3 T_world_map_guess = Align(pairs, options.alignment).T_world_map;
  CalibrationProblem problem(pairs, T_world_map_guess, options);
  problem.set_time_offset_s(time_offset_guess_s);
  result.status = CalibrationStatus::kNotConverged;
  if (!SolveInRounds(problem, estimate, reference, options)) return result;

  CalibrationProblem::Deviations sd = problem.StandardDeviations();
  if (std::abs(problem.time_offset_s()) > options.max_time_offset_s) sd[0] = std::numeric_limits<double>::infinity();
  std::vector<int> unexcited;
  for (int k = 0; k < CalibrationProblem::kCalibrated; ++k) {
    if (!IsExcited(sd, k, options)) unexcited.push_back(k);
  }
  if (!unexcited.empty()) {
    problem.HoldAtStart(unexcited);
    if (!SolveInRounds(problem, estimate, reference, options)) return result;
  }

  result.status = CalibrationStatus::kOk;
  result.time_offset_s = problem.time_offset_s();
  result.T_body_marker = problem.T_body_marker();
  result.T_world_map = problem.T_world_map();
  result.pairs = problem.samples();
  result.position_sigma_m = problem.position_sigma_m();
  result.orientation_sigma_rad = problem.orientation_sigma_rad();
  result.time_offset_sd_s = sd[0];
  result.lever_arm_sd_m = sd.segment<3>(1);
  result.rotation_sd_rad = sd.segment<3>(4);
  for (const int k : unexcited) result.unexcited.emplace_back(kParameterNames[static_cast<size_t>(k)]);
  return result;
}

}  // namespace lcmslam
