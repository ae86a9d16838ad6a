#include "trajectory/pose_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lcmslam {
namespace {

// from^-1 * to, without a normalization that nothing here needs: this runs many times a pose.
Pose3 Motion(const Pose3& from, const Pose3& to) {
  const Eigen::Quaterniond to_body = from.rotation.conjugate();
  return {to_body * (to.translation - from.translation), to_body * to.rotation};
}

// The motion from pair `from` to pair `to`, as the reference has it and as the estimate has it.
void AddRelative(const PosePair& from, const PosePair& to, PoseErrors& errors) {
  errors.Add(Motion(from.reference, to.reference), Motion(from.estimate, to.estimate));
}

// `position` never decreases: time or path length of each pair.
PoseErrors RelativeErrors(std::span<const PosePair> pairs, std::span<const double> position, double step) {
  PoseErrors errors;
  errors.Reserve(pairs.size());
  size_t j = 0;
  for (size_t i = 0; i + 1 < pairs.size(); ++i) {
    const double goal = position[i] + step;
    j = std::max(j, i + 1);
    while (j + 1 < pairs.size() && position[j] < goal) ++j;
    const bool previous_is_as_near = j > i + 1 && goal - position[j - 1] <= std::abs(position[j] - goal);
    const size_t nearest = previous_is_as_near ? j - 1 : j;
    if (std::abs(position[nearest] - goal) <= kStepTolerance * step) AddRelative(pairs[i], pairs[nearest], errors);
  }
  return errors;
}

}  // namespace

void PoseErrors::Add(const Pose3& reference, const Pose3& estimate) {
  translation_m.push_back((reference.translation - estimate.translation).norm());
  rotation_rad.push_back(AngleBetween(reference.rotation, estimate.rotation));
}

void PoseErrors::Reserve(size_t count) {
  translation_m.reserve(count);
  rotation_rad.reserve(count);
}

PoseErrors AbsoluteErrors(std::span<const PosePair> pairs) {
  PoseErrors errors;
  errors.Reserve(pairs.size());
  for (const PosePair& pair : pairs) errors.Add(pair.reference, pair.estimate);
  return errors;
}

std::vector<double> PathLengths(std::span<const PosePair> pairs, Pose3 PosePair::*side) {
  std::vector<double> lengths_m(pairs.size());
  for (size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::Vector3d step_m = (pairs[i].*side).translation - (pairs[i - 1].*side).translation;
    lengths_m[i] = lengths_m[i - 1] + step_m.norm();
  }
  return lengths_m;
}

PoseErrors RelativeErrorsOverTime(std::span<const PosePair> pairs, double step_s) {
  std::vector<double> times_us(pairs.size());  // whole numbers, so that ties are exact
  std::ranges::transform(pairs, times_us.begin(),
                         [&](const PosePair& pair) { return static_cast<double>(pair.utime - pairs.front().utime); });
  return RelativeErrors(pairs, times_us, std::round(step_s * 1e6));
}

PoseErrors RelativeErrorsOverDistance(std::span<const PosePair> pairs, std::span<const double> path_m, double step_m) {
  return RelativeErrors(pairs, path_m, step_m);
}

KittiErrors KittiSegmentErrors(std::span<const PosePair> pairs, std::span<const double> path_m) {
  constexpr std::array<double, 8> kLengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  constexpr size_t kStride = 10;
  std::array<size_t, kLengths_m.size()> lasts = {};
  PoseErrors errors;
  for (size_t first = 0; first < pairs.size(); first += kStride) {
    for (size_t k = 0; k < kLengths_m.size(); ++k) {
      size_t& last = lasts[k];
      while (last < path_m.size() && path_m[last] <= path_m[first] + kLengths_m[k]) ++last;
      if (last == path_m.size()) break;
      AddRelative(pairs[first], pairs[last], errors);
      errors.translation_m.back() /= kLengths_m[k];
      errors.rotation_rad.back() /= kLengths_m[k];
    }
  }
  return {std::move(errors.translation_m), std::move(errors.rotation_rad)};
}

Drift DriftPerMetre(std::span<const PosePair> pairs, std::span<const double> path_m) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Drift drift{
      .path_length_m = path_m.empty() ? 0.0 : path_m.back(), .translation_m_per_m = kNaN, .rotation_rad_per_m = kNaN};
  if (drift.path_length_m <= 0.0) return drift;
  PoseErrors whole;
  AddRelative(pairs.front(), pairs.back(), whole);
  drift.translation_m_per_m = whole.translation_m[0] / drift.path_length_m;
  drift.rotation_rad_per_m = whole.rotation_rad[0] / drift.path_length_m;
  return drift;
}

}  // namespace lcmslam
