#include "octo3d/options.h"

#include <cmath>

namespace lcmslam::octo3d {

namespace {

// The first complaint, or "".
class Check {
 public:
  Check& Field(const char* name, double value, double min, double max) {
    if (reason_.empty() && !(value >= min && value <= max)) {  // also NaN
      reason_ = std::string(name) + ": must be in [" + Text(min) + ", " + Text(max) + "]";
    }
    return *this;
  }
  Check& That(bool holds, const char* reason) {
    if (reason_.empty() && !holds) reason_ = reason;
    return *this;
  }
  Check& Group(const char* name, const std::string& reason) {
    if (reason_.empty() && !reason.empty()) reason_ = std::string(name) + "." + reason;
    return *this;
  }
  std::string Reason() const { return reason_; }

 private:
  static std::string Text(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }
  std::string reason_;
};

}  // namespace

std::string MapOptions::Validate() const {
  return Check()
      .Field("leaf_m", leaf_m, 0.01, 10.0)
      .Field("levels", levels, 1, 10)
      .Field("range_noise_m", range_noise_m, 1e-4, 1.0)
      .Field("min_points", min_points, 3, 1000)
      .Field("max_thickness", max_thickness, 0.1, 100.0)
      .Field("min_flatness", min_flatness, 1.0, 1000.0)
      .Field("curvature_per_m", curvature_per_m, 0.0, 10.0)
      .Field("refit_growth", refit_growth, 1.0, 10.0)
      .Reason();
}

std::string PatchOptions::Validate() const {
  return Check()
      .Field("min_range_m", min_range_m, 0.0, 100.0)
      .Field("max_range_m", max_range_m, 0.1, 1000.0)
      .That(min_range_m < max_range_m, "max_range_m: must exceed min_range_m")
      .Field("cell_m", cell_m, 0.02, 10.0)
      .Field("levels", levels, 1, 5)
      .Field("time_slices", time_slices, 1, 32)
      .Field("max_patches", max_patches, 100, 1000000)
      .Reason();
}

std::string RegistrationOptions::Validate() const {
  return Check()
      .Field("max_iterations", max_iterations, 1, 1000)
      .Field("kernel", kernel, 0.1, 100.0)
      .Field("model_error_m", model_error_m, 1e-6, 1.0)
      .Field("step_sigmas", step_sigmas, 1e-6, 10.0)
      .Field("acceleration_mps2", acceleration_mps2, 1e-3, 1000.0)
      .Field("angular_acceleration_radps2", angular_acceleration_radps2, 1e-3, 1000.0)
      .Field("min_direction_share", min_direction_share, 0.0, 0.3)
      .Reason();
}

std::string CoarseSearchOptions::Validate() const {
  return Check()
      .Field("max_patches", max_patches, 50, 100000)
      .Field("iterations", iterations, 1, 1000)
      .Field("reach_m", reach_m, 0.01, 100.0)
      .Reason();
}

std::string TrustOptions::Validate() const {
  return Check()
      .Field("min_patches", min_patches, 12, 100000)
      .Field("min_inlier_ratio", min_inlier_ratio, 0.0, 1.0)
      .Field("max_residual", max_residual, 0.1, 1000.0)
      .Field("initial_speed_mps", initial_speed_mps, 1e-3, 100.0)
      .Field("initial_rate_radps", initial_rate_radps, 1e-3, 100.0)
      .Field("set_pose_m", set_pose_m, 1e-5, 100.0)
      .Field("set_pose_rad", set_pose_rad, 1e-5, 10.0)
      .Field("hint_rotation_rad", hint_rotation_rad, 1e-5, 10.0)
      .Field("hint_translation_m", hint_translation_m, 1e-5, 10.0)
      .Field("hint_odometry_rad", hint_odometry_rad, 1e-5, 10.0)
      .Field("max_gap_s", max_gap_s, 0.01, 1000.0)
      .Reason();
}

std::string Options::Validate() const {
  return Check()
      .Group("map", map.Validate())
      .Group("patches", patches.Validate())
      .Group("registration", registration.Validate())
      .Group("search", search.Validate())
      .Group("trust", trust.Validate())
      .Field("max_points", max_points, 1000, 1e6)
      .Field("update_distance_m", update_distance_m, 0.0, 100.0)
      .Field("update_angle_rad", update_angle_rad, 0.0, 10.0)
      .Field("threads", threads, 1, 2)
      .Reason();
}

}  // namespace lcmslam::octo3d
